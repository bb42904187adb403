// Depth of field: a thin lens, by its circles of confusion.
#include "raytrace/pixels/section_plane.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr int pixels = 64;

RenderSettings square(int samples) {
  RenderSettings settings;
  settings.width = settings.height = pixels;
  settings.samples = samples;
  return settings;
}

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 1.0;
  settings.form_factors.rays = settings.interpolation.rays = 16;
  return settings;
}

/// From the origin along -z; the picture is two wide in the plane at distance one.
Camera with_lens(double radius, double focus) {
  Camera camera = look_at(Point3(0.0), {0, 0, -1}, std::numbers::pi / 2.0);
  camera.lens_radius = radius;
  camera.focus_distance = focus;
  return camera;
}

void add_lamp(Scene& scene, double half, double z, double front = 1.0) {
  const double h = half * front;
  add_polygon(scene, "lamp", {{-h, -half, z}, {h, -half, z}, {h, half, z}, {-h, half, z}},
              diffuse(0.0, std::numbers::pi));
}

// Where it is in focus a lamp is as sharp as by a pinhole: its edges are those of pixels.
TEST(Lens, WhatIsInFocusIsSharp) {
  Scene scene;
  add_lamp(scene, 1.5, -3.0); // half of the picture's width
  const Image image = picture(lit_up(scene, coarse()), with_lens(0.4, 3.0), square(64));
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 48;
      // A sample at the very edge may fall to either side.
      EXPECT_NEAR(image.at(x, y).g, inside ? 1.0 : 0.0, 1.0 / 64.0 + 1e-5) << x << ' ' << y;
    }
}

// The distance in a mirror is that on the way.
TEST(Lens, WhatIsInFocusByWayOfAMirrorIsSharp) {
  Scene scene;
  add_polygon(scene, "mirror", {{-5, -5, -2}, {5, -5, -2}, {5, 5, -2}, {-5, 5, -2}}, mirror(1.0));
  add_lamp(scene, 1.5, 1.0, -1.0); // looks to the mirror; 2 + 3 m on the way
  const double focus = 5.0;
  const Image image = picture(lit_up(scene, coarse()), with_lens(0.05, focus), square(64));
  double between = 0.0, sum = 0.0;
  for (const auto& pixel : image.pixels) {
    between += pixel.g > 0.02F && pixel.g < 0.98F ? 1.0 : 0.0;
    sum += pixel.g;
  }
  // 1.5 m at 5 m: 9.6 pixels from the middle; each of the four edges is in one row of pixels.
  EXPECT_NEAR(sum, 19.2 * 19.2, 0.01 * 19.2 * 19.2);
  EXPECT_LE(between, 4 * 20);
}

/// Moments of what a picture shows of a lamp in the middle, in pixels.
struct Spot {
  double sum = 0.0, variance = 0.0, farthest = 0.0;
};
Spot spot_of(const Image& image) {
  Spot spot;
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const double light = image.at(x, y).g;
      const Vec2 off = Vec2(x + 0.5, y + 0.5) - 0.5 * pixels;
      spot.sum += light;
      spot.variance += 0.5 * light * glm::dot(off, off);
      if (light > 0.0)
        spot.farthest = std::max(spot.farthest, glm::length(off));
    }
  spot.variance /= spot.sum;
  return spot;
}

// A small lamp at z spreads evenly over a circle, of the radius R abs(z - d) / z in the plane of
// focus at d, which is 2 d wide: its variance along an axis is a quarter of the radius squared. The
// lamp's own width and that of pixels add a twelfth of their squares.
TEST(Lens, TheCircleOfConfusionIsThatOfTheClosedForm) {
  constexpr double radius = 0.3, half = 0.02;
  for (const auto& [z, focus] : {std::pair(2.0, 4.0), std::pair(4.0, 2.0), std::pair(1.0, 1.5)}) {
    Scene scene;
    add_lamp(scene, half * z, -z); // 1.28 pixels wide
    const Taken lit = lit_up(scene, coarse());
    const Spot sharp = spot_of(picture(lit, with_lens(0.0, focus), square(1024)));
    const Spot seen = spot_of(picture(lit, with_lens(radius, focus), square(1024)));
    const double circle = radius * std::abs(z - focus) / z * 0.5 * pixels / focus;
    const double lamp = 2.0 * half * 0.5 * pixels, square = 0.25 * circle * circle;
    EXPECT_NEAR(seen.variance, square + (lamp * lamp + 1.0) / 12.0, 0.02 * square)
        << z << ' ' << focus;
    EXPECT_LT(seen.farthest, circle + 2.5);
    EXPECT_GT(seen.farthest, circle - 0.5);
    EXPECT_NEAR(seen.sum, sharp.sum, 0.01 * sharp.sum) << "the lens takes no light";
  }
}

TEST(Lens, IsCutOpenLikeAPinhole) {
  // What is before the section plane is gone, from wherever on the lens it would be seen.
  Scene scene;
  add_lamp(scene, 1.5, -3.0);
  Scene hidden = scene;
  add_polygon(hidden, "sheet", {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}},
              double_sided(diffuse(0.0)));
  Camera camera = with_lens(0.4, 2.0);
  const Image whole = picture(lit_up(scene, coarse()), camera, square(64));
  camera.znear = 1.5;
  const Camera cutting = with_section(hidden, camera, 1.0);
  ASSERT_GT(cutting.section, 1.4);
  const Image cut = picture(lit_up(hidden, coarse()), cutting, square(64));
  for (std::size_t k = 0; k < whole.pixels.size(); ++k)
    EXPECT_NEAR(cut.pixels[k].g, whole.pixels[k].g, 2.0 / 64.0); // rounding moves samples at edges
}

// The rim of a lens sees around what the centre does not.
TEST(Lens, TheSectionHeedsTheRim) {
  Scene scene; // beside the view of a pinhole at one metre, 1.1 m off its axis
  add_polygon(scene, "post", {{1.1, -1, -1}, {1.3, -1, -1}, {1.3, 1, -1}, {1.1, 1, -1}},
              double_sided(diffuse(0.5)));
  for (const double radius : {0.0, 0.3}) {
    Camera camera = with_lens(radius, 0.5);
    camera.znear = 1.2;
    EXPECT_EQ(with_section(scene, camera, 1.0).section > 0.0, radius > 0.0);
  }
}

} // namespace
} // namespace meninas::test
