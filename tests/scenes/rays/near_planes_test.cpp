#include "scenes/rays/ray_contacts.h"
#include "scenes/rays/near_planes.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas {
namespace {

constexpr double reach = 2e-6; // as ray queries use it

FrameGeometry geometry_of(const Scene& scene) {
  return make_frame_geometry(scene, find_surfaces(scene));
}

/// A packet of one ray that leaves the plane of a triangle.
RayPacket packet_from(const FrameGeometry& geometry, const Point3& origin, std::uint32_t triangle) {
  RayPacket packet{};
  packet.count = 1;
  packet.origin_x[0] = static_cast<float>(origin.x);
  packet.origin_y[0] = static_cast<float>(origin.y);
  packet.origin_z[0] = static_cast<float>(origin.z);
  packet.leaving[0] = geometry.facts[triangle].plane;
  return packet;
}

Point3 origin_of(const RayPacket& packet) {
  return {packet.origin_x[0], packet.origin_y[0], packet.origin_z[0]};
}

bool touches_another_plane(const FrameGeometry& geometry, const RayPacket& packet) {
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t)
    if (geometry.facts[t].plane != packet.leaving[0] &&
        distance_to(corners_of(geometry, t), origin_of(packet)) <= reach)
      return true;
  return false;
}

Scene tilted_room() {
  const auto turn = glm::normalize(Vec3(1.0, 2.0, -0.5));
  const auto side = glm::normalize(glm::cross(Vec3(0.3, -1.0, 2.0), turn));
  return test::transformed(test::half_room(), {turn, side, glm::cross(turn, side)}, 1.0,
                           {1.0, 2.0, 3.0});
}

TEST(NearPlanes, WhatIsOffAllElseTouchesNothing) {
  test::Random random(5);
  for (const Scene& scene : {test::half_room(), tilted_room()}) {
    const FrameGeometry geometry = geometry_of(scene);
    const NearPlanes near = find_near_planes(geometry, reach);
    int certain = 0, touching = 0;
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
      const auto corners = corners_of(geometry, t);
      for (int n = 0; n < 200; ++n) {
        // Near an edge as often as anywhere:
        // at all distances from it down to the rounding of floats.
        const double from_edge = std::pow(10.0, random.between(-8.0, 0.0));
        const double along = random.between(0.0, 1.0);
        const Point3 edge = glm::mix(corners[0], corners[1], along);
        const auto packet = packet_from(geometry, glm::mix(edge, corners[2], from_edge), t);
        const bool touches = touches_another_plane(geometry, packet);
        const bool off = lanes_off_all_else(near, packet, 1U) != 0;
        EXPECT_FALSE(off && touches) << "triangle " << t << ", " << from_edge;
        certain += off ? 1 : 0;
        touching += touches ? 1 : 0;
      }
    }
    EXPECT_GT(touching, 500);
    EXPECT_GT(certain, 500);
  }
}

TEST(NearPlanes, TheMiddleOfAWallIsOffAllElse) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(test::diffuse(0.5));
  test::add_room(scene, {-1, -1, -1}, {1, 1, 1}, walls);
  const FrameGeometry geometry = geometry_of(scene);
  const NearPlanes near = find_near_planes(geometry, reach);
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const auto corners = corners_of(geometry, t);
    const auto packet = packet_from(geometry, (corners[0] + corners[1] + corners[2]) / 3.0, t);
    EXPECT_EQ(lanes_off_all_else(near, packet, 1U), 1U);
  }
}

TEST(NearPlanes, NothingIsCertainOfRaysThatLeaveNoPlane) {
  const FrameGeometry geometry = geometry_of(test::half_room());
  auto packet = packet_from(geometry, Point3(0.0), 0);
  std::fill_n(packet.leaving, packet_size, no_index);
  EXPECT_EQ(lanes_off_all_else(find_near_planes(geometry, reach), packet, 0xffffU), 0U);
}

TEST(NearPlanes, PlanesAmongTooManyOthersAreLeftUnknown) {
  Scene scene;
  test::add_polygon(scene, "floor", {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}},
                    test::diffuse(0.5));
  for (int n = 0; n < 100; ++n) {
    const double x = -0.9 + 0.018 * n;
    test::add_polygon(scene, "screen", {{x, 0, -1}, {x, 0, 1}, {x, 1, 1}}, test::diffuse(0.5));
  }
  const FrameGeometry geometry = geometry_of(scene);
  const NearPlanes near = find_near_planes(geometry, reach);
  EXPECT_EQ(near.ranges[geometry.facts[0].plane].end, NearPlanes::unknown);
  const auto packet = packet_from(geometry, {-0.99, geometry.positions[0].y, 0.0}, 0);
  EXPECT_EQ(lanes_off_all_else(near, packet, 1U), 0U);
}

} // namespace
} // namespace meninas
