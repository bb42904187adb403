#include "scenes/rays/ray_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace meninas {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct World {
  Scene scene;
  SurfaceModel surfaces;
  RayScene rays;

  explicit World(Scene built)
      : scene(std::move(built)), surfaces(find_surfaces(scene)),
        rays(make_ray_scene(scene, surfaces)) {}

  std::string name(TriangleId triangle) const {
    return scene.nodes[index(scene.triangles[index(triangle)].node)].name;
  }
  PlaneId plane(const std::string& node) const {
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
      if (name(TriangleId{static_cast<std::uint32_t>(t)}) == node)
        return surfaces.plane_of_triangle[t];
    return none<PlaneId>;
  }
};

std::array<Material, 6> grey_walls() {
  std::array<Material, 6> walls;
  walls.fill(test::diffuse(0.5));
  return walls;
}

Scene room_scene() {
  Scene scene;
  test::add_room(scene, {0, 0, 0}, {2, 3, 4}, grey_walls());
  return scene;
}

// A square of side 2 in the plane z = height, its front towards +z or -z
void add_sheet(Scene& scene, const std::string& name, double height, double facing,
               const Material& material) {
  const auto s = facing;
  test::add_polygon(scene, name,
                    {{-1, -s, height}, {1, -s, height}, {1, s, height}, {-1, s, height}}, material);
}

glm::dmat3 some_rotation() {
  const auto x = glm::normalize(Vec3(1.0, 2.0, -0.5));
  const auto y = glm::normalize(glm::cross(Vec3(0.3, -1.0, 2.0), x));
  return {x, y, glm::cross(x, y)};
}

TEST(ClosestHit, MeasuresDistanceAndPlaceInMetres) {
  const World world(room_scene());
  const auto hit = closest_hit(world.rays, {{1.0, 1.0, 1.0}, {0.0, -1.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(world.name(hit->triangle), "y0");
  EXPECT_TRUE(hit->front);
  // Measured again in double: a few roundings of double
  EXPECT_NEAR(hit->distance, 1.0, 1e-14);
  const auto c = corners(world.scene, hit->triangle);
  const auto x = c[0] + hit->barycentric.x * (c[1] - c[0]) + hit->barycentric.y * (c[2] - c[0]);
  EXPECT_LT(glm::distance(x, Point3(1.0, 0.0, 1.0)), 1e-14);
}

TEST(ClosestHit, StopsAtTheLargestDistance) {
  const World world(room_scene());
  Ray ray{{1.0, 1.0, 1.0}, {0.0, -1.0, 0.0}};
  ray.max_distance = 0.999;
  EXPECT_FALSE(closest_hit(world.rays, ray));
  ray.max_distance = 1.001;
  EXPECT_TRUE(closest_hit(world.rays, ray));
}

TEST(ClosestHit, TellsBacksFromFronts) {
  const World world(room_scene());
  const Ray from_below{{1.0, -1.0, 1.0}, {0.0, 1.0, 0.0}};
  const auto back = closest_hit(world.rays, from_below);
  ASSERT_TRUE(back);
  EXPECT_EQ(world.name(back->triangle), "y0");
  EXPECT_FALSE(back->front);

  const auto through = closest_hit(world.rays, from_below, Backs::transparent);
  ASSERT_TRUE(through);
  EXPECT_EQ(world.name(through->triangle), "y1");
  EXPECT_TRUE(through->front);
  EXPECT_NEAR(through->distance, 4.0, 1e-14);
}

TEST(ClosestHit, DoubleSidedSurfacesAreNeverTransparent) {
  Scene scene;
  add_sheet(scene, "sheet", 0.0, 1.0, test::double_sided(test::diffuse(0.5)));
  const World world(scene);
  for (const double side : {1.0, -1.0}) {
    const auto hit =
        closest_hit(world.rays, {{0.2, 0.1, side}, {0.0, 0.0, -side}}, Backs::transparent);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->front, side > 0.0);
  }
}

TEST(ClosestHit, FarCamerasSeeAsSharplyAsNearOnes) {
  const World world(room_scene());
  const auto target = Point3(0.5, 0.0, 0.5);
  for (const double distance : {1e1, 1e4, 1e7}) {
    const auto direction = glm::normalize(Vec3(0.1, 1.0, 0.05));
    const auto hit = closest_hit(world.rays, {target - distance * direction, direction});
    ASSERT_TRUE(hit);
    EXPECT_FALSE(hit->front);
    // The origin itself is only known to 1e-16 of its distance.
    EXPECT_NEAR(hit->distance, distance, 1e-14 * distance + 1e-14);
  }
}

TEST(ClosestHit, TheSideOfASheetThatFacesTheRayIsHit) {
  // Two coincident surfaces with different diagonals, at arbitrary places:
  // however Embree rounds, never the back
  for (const double scale : {1.0, 1e-4, 1e4})
    for (const auto& offset : {Vec3(0.0), Vec3(3.7, -1.3, 11.9)}) {
      Scene sheet;
      add_sheet(sheet, "up", 0.0, 1.0, test::diffuse(0.5));
      test::add_polygon(sheet, "down", {{1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}},
                        test::diffuse(0.5));
      const auto rotation = some_rotation();
      const World world(test::transformed(sheet, rotation, scale, scale * offset));
      for (int n = 0; n < 4000; ++n) {
        const auto x = std::fmod(0.618034 * n, 1.98) - 0.99;
        const auto y = std::fmod(0.754878 * n, 1.98) - 0.99;
        const auto tilt = std::fmod(0.569840 * n, 1.5);
        const double side = n % 2 == 0 ? 1.0 : -1.0;
        const auto direction = Vec3(std::sin(tilt), 0.0, -side * std::cos(tilt));
        const auto origin = Point3(x, y, 0.0) - 2.0 * direction;
        const auto hit = closest_hit(world.rays, {scale * (rotation * origin) + scale * offset,
                                                  glm::normalize(rotation * direction)});
        ASSERT_TRUE(hit);
        ASSERT_TRUE(hit->front);
        ASSERT_EQ(world.name(hit->triangle), side > 0.0 ? "up" : "down");
      }
    }
}

// The corners of the copy begin elsewhere, and its quad is cut along the same diagonal:
// Embree's distances to the two differ by rounding, from ray to ray.
TEST(ClosestHit, OneOfTwoFacesInOnePlaceIsMetByAllRays) {
  const auto seen = [](const Material& first, const Material& second) {
    Scene scene;
    const std::array<Point3, 3> p{Point3(-1, -1, 0.1), Point3(1, -1, 0.2), Point3(0.3, 1, 0.4)};
    test::add_polygon(scene, "first", {p[0], p[1], p[2]}, first);
    test::add_polygon(scene, "second", {p[1], p[2], p[0]}, second);
    const World world(test::transformed(scene, some_rotation(), 1.0, Vec3(3.7, -1.3, 11.9)));
    std::set<std::string> names;
    for (int n = 0; n < 1000; ++n) {
      const double a = std::fmod(0.618034 * n, 1.0), b = (1.0 - a) * std::fmod(0.754878 * n, 1.0);
      const Point3 target = (1.0 - a - b) * p[0] + a * p[1] + b * p[2];
      const Direction direction =
          some_rotation() * glm::normalize(Vec3(std::fmod(0.57 * n, 1.2) - 0.6, 0.2, -1.0));
      const Point3 origin = some_rotation() * target + Vec3(3.7, -1.3, 11.9) - 2.0 * direction;
      if (const auto hit = closest_hit(world.rays, {origin, direction}))
        names.insert(std::string(world.name(hit->triangle)));
    }
    EXPECT_EQ(names.size(), 1u);
    return names.empty() ? "" : *names.begin();
  };
  const Material paint = test::diffuse(0.5), lamp = test::diffuse(0.5, 1.0);
  EXPECT_EQ(seen(paint, test::diffuse(0.2)), "first");
  EXPECT_EQ(seen(paint, lamp), "second") << "an emitter comes first";
  EXPECT_EQ(seen(lamp, paint), "first");
  EXPECT_EQ(seen(paint, test::double_sided(paint)), "second") << "it is there from behind as well";
  Material leaf = paint;
  leaf.alpha_mode = AlphaMode::mask;
  EXPECT_EQ(seen(leaf, paint), "second") << "what may have holes hides nothing";
}

TEST(ClosestHit, ALeftPlaneIsNotHitAgain) {
  Scene scene;
  add_sheet(scene, "floor", 0.0, 1.0, test::diffuse(0.5));
  const World world(scene);
  Ray ray{{0.3, 0.2, -1e-9}, glm::normalize(Vec3(0.3, 0.1, 1.0)), world.plane("floor")};
  EXPECT_FALSE(closest_hit(world.rays, ray));
  ray.leaving = none<PlaneId>;
  EXPECT_TRUE(closest_hit(world.rays, ray));
}

TEST(ClosestHit, AConvexEdgeDoesNotStopRaysThatLeaveBesideIt) {
  // On top of a box, near and on its edges: nothing is there to be hit, in any upward direction.
  Scene scene;
  test::add_box(scene, "box", {-1, -1, -1}, {1, 1, 1}, test::diffuse(0.5));
  test::add_box(scene, "far", {90, 0, 0}, {91, 1, 1}, test::diffuse(0.5));
  const World world(scene);
  for (const double inset : {0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-3})
    for (int n = 0; n < 360; ++n) {
      const auto angle = n * std::numbers::pi / 180.0;
      for (const double height : {1e-3, 0.1, 1.0}) {
        const auto direction = glm::normalize(Vec3(std::cos(angle), height, std::sin(angle)));
        const auto edge =
            closest_hit(world.rays, {{1.0 - inset, 1.0, 0.3}, direction, world.plane("box.y1")});
        EXPECT_TRUE(!edge || world.name(edge->triangle).starts_with("far")) << inset << " " << n;
        const auto corner = closest_hit(
            world.rays, {{1.0 - inset, 1.0, 1.0 - inset}, direction, world.plane("box.y1")});
        EXPECT_TRUE(!corner || world.name(corner->triangle).starts_with("far"))
            << inset << " " << n;
      }
    }
}

TEST(ClosestHit, WhatIsNotARayMeetsNothing) {
  const World world(room_scene());
  const Point3 inside(1.0, 1.0, 1.0);
  for (const auto& direction : {Vec3(0.0), Vec3(nan, 0.0, 1.0), Vec3(infinity, 0.0, 0.0)})
    EXPECT_FALSE(closest_hit(world.rays, {inside, direction}));
  for (const auto& origin : {Point3(nan, 0.0, 0.0), Point3(0.0, infinity, 0.0)}) {
    EXPECT_FALSE(closest_hit(world.rays, {origin, {0.0, 1.0, 0.0}}));
    EXPECT_FALSE(occluded(world.rays, Leg{origin, inside}));
    EXPECT_FALSE(occluded(world.rays, Leg{inside, origin}));
  }
  EXPECT_FALSE(occluded(world.rays, Leg{inside, inside}));
  Ray ray{inside, {0.0, 1.0, 0.0}};
  for (const double distance : {nan, 0.0, -1.0}) {
    ray.max_distance = distance;
    EXPECT_FALSE(closest_hit(world.rays, ray));
  }
}

TEST(ClosestHit, AnEmptySceneIsMissed) {
  const World world(Scene{});
  EXPECT_FALSE(closest_hit(world.rays, {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(occluded(world.rays, Leg{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}));
}

TEST(Occluded, EitherSideBlocks) {
  Scene scene;
  add_sheet(scene, "sheet", 0.0, 1.0, test::diffuse(0.5));
  const World world(scene);
  EXPECT_TRUE(occluded(world.rays, Leg{{0.2, 0.1, 1.0}, {0.1, 0.3, -1.0}}));
  EXPECT_TRUE(occluded(world.rays, Leg{{0.2, 0.1, -1.0}, {0.1, 0.3, 1.0}}));
  EXPECT_FALSE(occluded(world.rays, Leg{{0.2, 0.1, 1.0}, {0.1, 0.3, 0.1}}));
  EXPECT_FALSE(occluded(world.rays, Leg{{1.2, 0.1, -1.0}, {1.1, 0.3, 1.0}}));
}

TEST(Occluded, AnEndOnASurfaceIsNotBlockedByIt) {
  const World world(room_scene());
  const Leg leg{{0.4, 0.0, 1.0}, {0.0, 2.0, 3.0}, world.plane("y0"), world.plane("x0")};
  EXPECT_FALSE(occluded(world.rays, leg));
}

TEST(Occluded, ADistantEndIsReached) {
  Scene scene;
  add_sheet(scene, "sheet", 0.0, 1.0, test::diffuse(0.5));
  const World world(scene);
  const auto far = 1e6 * glm::normalize(Vec3(0.2, 0.3, 1.0));
  EXPECT_FALSE(occluded(world.rays, Leg{{0.3, 0.2, 0.0}, far, world.plane("sheet")}));
  EXPECT_TRUE(occluded(world.rays, Leg{{0.3, 0.2, -0.001}, far}));
}

TEST(Packets, AgreeWithSingleRaysAndLeaveOtherLanesAlone) {
  Scene scene = room_scene();
  test::add_box(scene, "box", {0.5, 0.5, 1.0}, {1.2, 1.0, 2.5}, test::diffuse(0.5));
  const World world(scene);
  const auto& frame = world.rays.frame();
  const Point3 eye(0.3, 2.0, 0.4);
  for (const std::uint32_t count : {0U, 1U, 5U, 16U}) {
    RayPacket packet{};
    packet.count = count;
    const auto origin = (eye - frame.centre) * frame.scale;
    for (std::size_t k = 0; k < packet_size; ++k) {
      const auto direction = glm::normalize(Vec3(0.1 * static_cast<double>(k) - 0.5, -0.7, 0.8));
      packet.origin_x[k] = static_cast<float>(origin.x);
      packet.origin_y[k] = static_cast<float>(origin.y);
      packet.origin_z[k] = static_cast<float>(origin.z);
      packet.direction_x[k] = static_cast<float>(direction.x);
      packet.direction_y[k] = static_cast<float>(direction.y);
      packet.direction_z[k] = static_cast<float>(direction.z);
      packet.max_distance[k] = std::numeric_limits<float>::infinity();
      packet.leaving[k] = packet.arriving[k] = index(none<PlaneId>);
    }
    packet.direction_x[3] = std::numeric_limits<float>::quiet_NaN();
    packet.direction_x[4] = packet.direction_y[4] = packet.direction_z[4] = 0.0F;
    for (const auto coherence : {Coherence::coherent, Coherence::incoherent}) {
      HitPacket hits;
      closest_hits(world.rays, packet, hits, Backs::absorb, coherence);
      std::uint32_t expected = 0;
      for (std::size_t k = 0; k < packet_size; ++k) {
        const Vec3 direction(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
        const auto hit = k < count ? closest_hit(world.rays, {eye, direction}) : std::nullopt;
        ASSERT_EQ(hits.triangle[k], hit ? index(hit->triangle) : index(none<TriangleId>)) << k;
        if (!hit)
          continue;
        expected |= 1U << k;
        EXPECT_EQ(hits.front[k] != 0, hit->front);
        // Rounded to floats in a frame of size 1:
        // a few times 6e-8, and hits that are met at an angle
        EXPECT_NEAR(hits.distance[k] / frame.scale, hit->distance, 1e-5);
        EXPECT_NEAR(hits.b1[k], hit->barycentric.x, 1e-5);
        EXPECT_NEAR(hits.b2[k], hit->barycentric.y, 1e-5);
      }
      EXPECT_EQ(occluded(world.rays, packet, coherence), expected);
    }
  }
}

} // namespace
} // namespace meninas
