#include "scenes/surfaces/closedness.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

constexpr double tolerance = 1e-9;

Scene cube_room() {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  return scene;
}

void remove_last_quad(Scene& scene) { scene.triangles.resize(scene.triangles.size() - 2); }

TEST(Closedness, ARoomIsClosedUntilAWallIsMissing) {
  Scene scene = cube_room();
  EXPECT_TRUE(is_closed(scene, tolerance));
  remove_last_quad(scene);
  EXPECT_FALSE(is_closed(scene, tolerance));
  EXPECT_FALSE(is_closed(Scene{}, tolerance));
}

TEST(Closedness, OneMissingTriangleIsAGap) {
  Scene scene = cube_room();
  scene.triangles.pop_back();
  EXPECT_FALSE(is_closed(scene, tolerance));
}

TEST(Closedness, LooseThingsInsideDoNotOpenARoom) {
  Scene scene = cube_room();
  add_polygon(scene, "lamp", {{0.4, 0.9, 0.4}, {0.6, 0.9, 0.4}, {0.6, 0.9, 0.6}, {0.4, 0.9, 0.6}},
              diffuse(0.0, 1.0));
  // A screen that meets the floor along an edge two walls share.
  add_polygon(scene, "screen", {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.5, 1.0, 0.5}, {0.5, 0.0, 0.5}},
              diffuse(0.5));
  EXPECT_TRUE(is_closed(scene, tolerance));
}

TEST(Closedness, AClosedBoxInAnOpenRoomDoesNotCloseIt) {
  Scene scene = cube_room();
  remove_last_quad(scene);
  add_box(scene, "box", Point3(0.2), Point3(0.4), diffuse(0.5));
  EXPECT_FALSE(is_closed(scene, tolerance));
}

TEST(Closedness, ALongEdgeMayMeetShorterOnes) {
  Scene scene = cube_room();
  remove_last_quad(scene);
  // The wall z = 1 as two halves, whose edges lie on the long edges of floor and ceiling.
  add_polygon(scene, "half", {{0.5, 0.0, 1.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 1.0}, {0.5, 1.0, 1.0}},
              diffuse(0.5));
  EXPECT_FALSE(is_closed(scene, tolerance));
  add_polygon(scene, "rest", {{1.0, 0.0, 1.0}, {0.5, 0.0, 1.0}, {0.5, 1.0, 1.0}, {1.0, 1.0, 1.0}},
              diffuse(0.5));
  EXPECT_TRUE(is_closed(scene, tolerance));
}

TEST(Closedness, HoldsAtAnyScaleAndPlace) {
  for (const double scale : {1e-4, 1e4}) {
    const Scene moved = transformed(cube_room(), glm::dmat3(1.0), scale, Vec3(100.0 * scale));
    EXPECT_TRUE(is_closed(moved, 1e-9 * scale));
  }
}

} // namespace
} // namespace meninas::test
