#include "mirror/virtual_lights.h"
#include "tests/mirror/lambert.h"
#include "tests/mirror/glowing_room.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

double seen_light(const GlowingRoom& room, const Point3& x, const Direction& normal) {
  std::vector<VirtualLight> lights;
  virtual_lights(room.worlds, room.emitters, x, normal, 0.0, lights);
  double sum = 0.0;
  for (const auto& light : lights)
    sum += form_factor(x, normal, light.polygon);
  return sum;
}

void expect_whole_hemisphere(const GlowingRoom& room, double tolerance) {
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const Point3 x = random.in_box(Vec3(0.05), {0.95, 1.45, 1.95});
    EXPECT_NEAR(seen_light(room, x, random.direction()), 1.0, tolerance);
  }
}

// Perfect mirrors in a room that glows everywhere:
// in whatever direction an observer looks there is light of one radiance,
// and the parts of all images in all worlds tile the hemisphere without gap or overlap: sum F = 1.
// The tolerance is the rounding of some tens of polygons.
TEST(VirtualLights, TileTheHemisphereWithoutMirrors) {
  expect_whole_hemisphere(glowing(room_with_mirrors({}), {}), 1e-12);
}
TEST(VirtualLights, TileTheHemisphereWithOneMirror) {
  expect_whole_hemisphere(glowing(room_with_mirrors({true}), {}), 1e-12);
}
TEST(VirtualLights, TileTheHemisphereInACornerOfTwoMirrors) {
  expect_whole_hemisphere(glowing(room_with_mirrors({true, false, true}), {}), 1e-12);
}
TEST(VirtualLights, TileTheHemisphereInACornerOfThreeMirrors) {
  expect_whole_hemisphere(glowing(room_with_mirrors({true, false, true, false, true, false}), {}),
                          1e-12);
}

// Of two facing mirrors, what lies deeper than the last world is missing: beyond 60 m the walls
// between them, 1.5 m by 2 m, fill a form factor of at most 1.5 * 2 / (60^2 pi) on either side.
TEST(VirtualLights, TileTheHemisphereBetweenFacingMirrors) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 60, .max_worlds = 1000};
  expect_whole_hemisphere(glowing(room_with_mirrors({true, true}), deep),
                          2.0 * 3.0 / (3600.0 * std::numbers::pi));
}

TEST(VirtualLights, TileTheHemisphereWithAMirrorInTheMiddleOfAWall) {
  expect_whole_hemisphere(glowing(room_with_mirror_in_wall(), {}), 1e-12);
}

TEST(VirtualLights, TileTheHemisphereWithATiltedMirror) {
  GlowingRoom room = glowing(room_with_wedge(), {});
  // The wedge hides the corner behind it, which virtual lights do not know of:
  // only the reflected part is looked at.
  Random random(9);
  for (int k = 0; k < 100; ++k) {
    const Point3 x = random.in_box({0.55, 0.05, 0.75}, {0.95, 1.45, 1.95});
    const Direction n = random.direction();
    std::vector<VirtualLight> lights;
    virtual_lights(room.worlds, room.emitters, x, n, 0.0, lights);
    double reflected = 0.0;
    for (const auto& light : lights)
      if (light.world != real_world)
        reflected += form_factor(x, n, light.polygon);
    const ConvexPolygon window = clip(room.mirrors.mirrors[0].window[0], x, n);
    EXPECT_NEAR(reflected, window.empty() ? 0.0 : form_factor(x, n, window), 1e-12);
  }
}

TEST(VirtualLights, FaceTheObserverAboveItsHorizon) {
  const GlowingRoom room = glowing(room_with_mirrors({true, false, true, false, false, true}), {});
  Random random(11);
  std::vector<VirtualLight> lights;
  for (int k = 0; k < 50; ++k) {
    const Point3 x = random.in_box(Vec3(0.05), {0.95, 1.45, 1.95});
    const Direction n = random.direction();
    virtual_lights(room.worlds, room.emitters, x, n, 0.0, lights);
    for (const auto& light : lights) {
      EXPECT_LT(glm::dot(light.normal, light.polygon.vertices[0] - x), 0.0);
      for (const auto& y : light.polygon.span())
        EXPECT_GE(glm::dot(n, y - x), -1e-13);
    }
  }
}

TEST(VirtualLights, StorageIsCleared) {
  const GlowingRoom room = glowing(room_with_mirrors({}), {});
  std::vector<VirtualLight> lights(5);
  virtual_lights(room.worlds, {}, Point3(0.5), {0, 0, 1}, 0.0, lights);
  EXPECT_TRUE(lights.empty());
}

bool inside(const ConvexPolygon& polygon, const Point3& x, double slack) {
  const Direction n = glm::normalize(area_vector(polygon.span()));
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Point3& a = polygon.vertices[k];
    const Vec3 edge = polygon.vertices[(k + 1) % polygon.size] - a;
    if (glm::dot(glm::cross(edge, x - a), n) < -slack)
      return false;
  }
  return true;
}

bool inside_window(const Mirror& mirror, const Point3& x, double slack) {
  for (const auto& part : mirror.window)
    if (inside(part, x, slack))
      return true;
  return false;
}

// A folded path is as long as the segment it unfolds to, meets the mirrors of its chain in order
// inside their windows, obeys the law of reflection at each, and ends on the real emitter.
TEST(FoldLegs, ObeyTheLawOfReflection) {
  constexpr double rounding = 1e-11; // chains of six in a room of 2 m lie 12 m away
  const GlowingRoom room = glowing(room_with_mirrors({true, true, true, false, true, false}),
                                   {.min_throughput = 0.0, .max_depth = 6, .max_worlds = 2000});
  Random random(13);
  std::vector<VirtualLight> lights;
  std::vector<Leg> legs;
  int deep = 0;
  for (int k = 0; k < 40; ++k) {
    const Point3 x = random.in_box(Vec3(0.1), {0.9, 1.4, 1.9});
    virtual_lights(room.worlds, room.emitters, x, random.direction(), 0.0, lights);
    for (const auto& light : lights) {
      // A point inside the visible part, away from its border.
      Point3 y(0.0);
      for (const auto& corner : light.polygon.span())
        y += corner / double(light.polygon.size);
      const auto chain = chain_of(room.worlds, light.world);
      const Emitter& emitter = room.emitters[light.emitter];
      fold_legs(room.worlds, room.mirrors, light.world, {x, y, PlaneId{77}, emitter.plane_class},
                legs);
      ASSERT_EQ(legs.size(), chain.size() + 1);
      EXPECT_EQ(legs.front().from, x);
      EXPECT_EQ(legs.front().leaving, PlaneId{77});
      EXPECT_EQ(legs.back().arriving, emitter.plane_class);
      double length = 0.0;
      for (const auto& leg : legs)
        length += glm::distance(leg.from, leg.to);
      EXPECT_NEAR(length, glm::distance(x, y), rounding);
      for (std::size_t m = 0; m < chain.size(); ++m) {
        const Mirror& mirror = room.mirrors.mirrors[index(chain[m])];
        EXPECT_EQ(legs[m].to, legs[m + 1].from);
        EXPECT_EQ(legs[m].arriving, mirror.plane_class);
        EXPECT_EQ(legs[m + 1].leaving, mirror.plane_class);
        EXPECT_NEAR(signed_distance(mirror.plane, legs[m].to), 0.0, rounding);
        EXPECT_TRUE(inside_window(mirror, legs[m].to, rounding));
        const Vec3 in = legs[m].to - legs[m].from, out = legs[m + 1].to - legs[m + 1].from;
        if (glm::length(in) < 1e-6 || glm::length(out) < 1e-6)
          continue;
        EXPECT_LT(
            glm::distance(reflect_direction(mirror.plane, glm::normalize(in)), glm::normalize(out)),
            1e-8);
      }
      EXPECT_NEAR(signed_distance(emitter.plane, legs.back().to), 0.0, rounding);
      EXPECT_TRUE(inside(ConvexPolygon(emitter.corners), legs.back().to, rounding));
      if (chain.size() >= 4)
        ++deep;
    }
  }
  EXPECT_GT(deep, 100);
}

} // namespace
} // namespace meninas::test
