// A lamp of many faces lights a room as all of its faces do.
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/light/lamp_faces.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A ball of 2 n^2 quads and triangles that glows, in a room.
Scene room_with_bulb(int n) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, {0, 0, 0}, {4, 2.6, 4}, walls);
  const auto at = [&](int i, int k) {
    const double polar = std::numbers::pi * i / n, turn = std::numbers::pi * k / n;
    return Point3(2.0, 1.6, 2.0) + 0.15 * Vec3(std::sin(polar) * std::cos(turn), std::cos(polar),
                                               -std::sin(polar) * std::sin(turn));
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      std::vector<Point3> face{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
      if (i == 0)
        face.pop_back();
      if (i == n - 1)
        face.erase(face.begin() + 2);
      add_polygon(scene, "bulb", face, diffuse(0.5, 10.0));
    }
  return scene;
}

TEST(LampFaces, FewOfThemStandForAll) {
  const auto l = lit(room_with_bulb(24), {.element_size = 0.5});
  ASSERT_TRUE(has_lamp_of_many_faces(*l->light));
  DirectWorkspace work;
  double sum = 0.0, exact = 0.0, squares = 0.0;
  constexpr int points = 64;
  for (int k = 0; k < points; ++k) {
    const Receiver floor{{0.3 + 0.4 * (k % 8), 0.01, 0.3 + 0.4 * (k / 8)}, {0, 1, 0}};
    const double few = direct_irradiance(*l->light, floor, {}, 17U + k, work).total.r;
    const double all =
        direct_irradiance(*l->light, floor, {.images = 1 << 24}, 17U + k, work).total.r;
    sum += few;
    exact += all;
    squares += (few / all - 1.0) * (few / all - 1.0);
  }
  // 32 steps whose estimates are off by a quarter or so: 5 % each at the most, and no bias.
  EXPECT_LT(std::sqrt(squares / points), 0.06);
  EXPECT_NEAR(sum, exact, 0.02 * exact);
}

TEST(LampFaces, AreSmallEmittersOfLampsOfMany) {
  const auto l = lit(room_with_bulb(24), {.element_size = 0.5});
  const auto few = lit(room_with_bulb(6), {.element_size = 0.5});
  for (std::uint32_t e = 0; e < element_count(l->mesh); ++e)
    EXPECT_EQ(is_face_of_lamp(*l->light, ElementId{e}), l->mesh.emission[e] != Rgb(0.0));
  for (std::uint32_t e = 0; e < element_count(few->mesh); ++e)
    EXPECT_FALSE(is_face_of_lamp(*few->light, ElementId{e}));
  EXPECT_EQ(images_to_choose(*few->light, 256), 256U);
  EXPECT_EQ(images_to_choose(*l->light, 256), 32U);
}

} // namespace
} // namespace meninas::test
