// Sides without elements are those that no light can reach, whatever it comes from.
#include "radiosity/mesh/dark_sides.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// A double-sided plate of one square metre at y = 0, which sees nothing but what is not there.
Scene plate() {
  Scene scene;
  add_polygon(scene, "plate", {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}},
              double_sided(diffuse(0.5)));
  return scene;
}

/// Of the first patch: front and back.
std::array<bool, 2> dark_sides(const Scene& scene) {
  const SurfaceModel surfaces = find_surfaces(scene);
  const auto [front, back] = find_dark_sides(scene, surfaces, make_ray_scene(scene, surfaces))[0];
  return {front != 0, back != 0};
}

constexpr std::array neither{false, false}, the_back{false, true}, both{true, true};

TEST(DarkSides, AreBothOfASheetInTheVoid) { EXPECT_EQ(dark_sides(plate()), both); }

TEST(DarkSides, AreNoneUnderASky) {
  Scene scene = plate();
  scene.background = Rgb(0.0, 0.0, 1.0);
  EXPECT_EQ(dark_sides(scene), neither);
}

TEST(DarkSides, AreThoseThatPunctualLightsAreBehind) {
  Scene scene = plate();
  PunctualLight bulb;
  bulb.position = {0.5, 2.0, 0.5};
  scene.lights = {bulb};
  EXPECT_EQ(dark_sides(scene), the_back);

  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = glm::normalize(Vec3(0.3, -1.0, 0.2));
  scene.lights = {sun};
  EXPECT_EQ(dark_sides(scene), the_back);
  // From below another light comes to the other side.
  sun.direction = {0.0, 1.0, 0.0};
  scene.lights.push_back(sun);
  EXPECT_EQ(dark_sides(scene), neither);
}

TEST(DarkSides, AreThoseThatAnEmitterIsBehind) {
  Scene scene = plate();
  add_polygon(scene, "lamp", {{0.4, 2, 0.4}, {0.6, 2, 0.4}, {0.6, 2, 0.6}, {0.4, 2, 0.6}},
              diffuse(0.0, 1.0));
  EXPECT_EQ(dark_sides(scene), the_back);
}

TEST(DarkSides, AreNoneOfATranslucentPlate) {
  Scene scene = plate();
  scene.materials[0].diffuse_transmission = 0.5;
  PunctualLight bulb;
  bulb.position = {0.5, 2.0, 0.5};
  scene.lights = {bulb};
  EXPECT_EQ(dark_sides(scene), neither) << "what is lit on one side is seen on the other";
}

TEST(DarkSides, AreTheOuterOnesOfARoomLitFromInside) {
  Scene scene;
  const Material wall = double_sided(diffuse(0.5));
  add_room(scene, {0, 0, 0}, {1, 1, 1}, {wall, wall, wall, wall, wall, wall});
  PunctualLight bulb;
  bulb.position = {0.5, 0.5, 0.5};
  scene.lights = {bulb};
  EXPECT_EQ(dark_sides(scene), the_back);
}

} // namespace
} // namespace meninas::test
