// Light from the source on elements: points shared out among many elements bring them, all together, the light that they receive.
#include "radiosity/element_light.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

TEST(ElementLight, ManyElementsShareTheirPoints) {
  const DirectSettings settings{.points = 16, .most_points = 256, .points_in_all = 8192};
  const auto points = [&](std::size_t elements) { return shared_out(settings, elements).points; };
  EXPECT_EQ(points(1), 16);
  EXPECT_EQ(points(512), 16);
  EXPECT_EQ(points(1024), 8);
  EXPECT_EQ(points(1500), 8); // a power of two, rather too many
  EXPECT_EQ(points(8192), 1);
  EXPECT_EQ(points(1'000'000), 1);
  EXPECT_EQ(shared_out(settings, 1024).most_points, 64);
  EXPECT_EQ(shared_out(settings, 1'000'000).most_points, 1);
  EXPECT_EQ(shared_out({.points = 16}, 1'000'000).points, 16);
}

/// The mean over the ceiling of what a floor of E = 1 sends to it, from a metre below.
double on_ceiling(Scene scene, const DirectSettings& settings) {
  const auto l = lit(std::move(scene), {.element_size = 1.0 / 64.0});
  return mean_over(*l, direct_irradiance(*l->light, {}, settings).irradiance, "ceiling").g;
}

Scene plates() {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5, 1.0));
  add_polygon(scene, "ceiling", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, diffuse(0.5));
  return scene;
}

// F = 0.199824895698387383 (C-11). A point in each of 64 x 64 elements: the light differs by 0.2 a metre, by 1.3e-3 within an element, their mean by a 64th of that, 2e-5.
TEST(ElementLight, OnePointInEachOfManyElementsIsEnough) {
  const double mean = on_ceiling(plates(), {.points_in_all = 4096});
  EXPECT_NEAR(mean, 0.199824895698387383, 4 * 2e-5);
}

// A plate halfway up hides a half and more of the floor. In its penumbra, half of the ceiling, single points are off by a third of what is there, the mean over 2,000
// of them by 0.2 x 0.33 / 64 = 1e-3.
TEST(ElementLight, PenumbraeAreNeitherDarkerNorBrighter) {
  Scene scene = plates();
  add_polygon(scene, "plate", {{0, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 1}, {0, 0.5, 1}},
              double_sided(diffuse(0.0)));
  const double many = on_ceiling(scene, {.points = 64, .most_points = 1024}),
               one = on_ceiling(scene, {.points_in_all = 4096});
  EXPECT_LT(many, 0.15);
  EXPECT_NEAR(one, many, 4 * 1e-3);
}

} // namespace
} // namespace meninas::test
