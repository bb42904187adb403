#include "radiosity/transport/hemisphere_samples.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

float unit(test::Random& random) {
  // As the net gives them: multiples of 2^-24 below 1
  return static_cast<float>(std::floor(random.between(0.0, 0x1p24))) * 0x1p-24F;
}

TEST(ReceiverRays, SixteenCosineDirectionsAreThoseOneByOne) {
  test::Random random(3);
  for (int n = 0; n < 1000; ++n) {
    LaneFloats u, v;
    for (std::size_t k = 0; k < packet_size; ++k) {
      u[k] = unit(random);
      v[k] = unit(random);
    }
    u[0] = v[0] = 0.5F; // the centre, where no angle is defined
    u[1] = 0.0F;        // the rim
    const LaneDirections lanes = cosine_hemisphere(u, v);
    for (std::size_t k = 0; k < packet_size; ++k) {
      const glm::vec3 one = cosine_hemisphere(u[k], v[k]);
      // A few roundings of floats; at the rim z = sqrt(1 - r^2) turns 1e-7 into its root.
      EXPECT_NEAR(lanes.x[k], one.x, 4e-7F);
      EXPECT_NEAR(lanes.y[k], one.y, 4e-7F);
      EXPECT_NEAR(lanes.z[k] * lanes.z[k], one.z * one.z, 8e-7F);
      EXPECT_GT(lanes.z[k], 0.0F);
    }
  }
}

class ReceiverRaysOf : public testing::TestWithParam<bool> {};

TEST_P(ReceiverRaysOf, RaysStartInTheReceiverAndLeaveIt) {
  ReceiverArea area;
  area.corner = {10.0, 20.0, 30.0};
  area.edge_u = {2.0, 0.0, 1.0};
  area.edge_v = {0.0, 3.0, 1.0};
  area.normal = glm::normalize(glm::cross(area.edge_u, area.edge_v));
  area.triangle = GetParam();
  area.plane_class = PlaneId{7};
  const RayFrame frame{{10.0, 20.0, 31.0}, 0.25};
  const HemisphereSamples net = make_direction_net(64);
  const RaySource source = ray_source(area, frame, 42);
  ASSERT_EQ(net.packets.size(), 4U);

  Vec3 mean(0.0);
  for (const NetPacket& packet_of_net : net.packets) {
    RayPacket packet;
    set_rays(packet_of_net, source, packet);
    for (std::size_t k = 0; k < packet_size; ++k) {
      const Vec3 origin{packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]};
      const Vec3 direction{packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]};
      const Vec3 h = origin / frame.scale + frame.centre - area.corner;
      // Coordinates of size 1 in the frame are rounded by 6e-8,
      // a quarter of that in metres times 4.
      EXPECT_NEAR(glm::dot(h, area.normal), 0.0, 1e-6);
      const double s = h.x / area.edge_u.x, t = h.y / area.edge_v.y;
      EXPECT_GE(s, -1e-6);
      EXPECT_GE(t, -1e-6);
      EXPECT_LE(GetParam() ? s + t : std::max(s, t), 1.0 + 1e-6);
      EXPECT_GT(glm::dot(direction, area.normal), 0.0);
      EXPECT_NEAR(glm::length(direction), 1.0, 1e-6);
      EXPECT_EQ(packet.leaving[k], 7U);
      mean += direction / 64.0;
    }
  }
  // The mean of cosine-distributed directions is 2/3 of the normal;
  // 64 points of a net come within a few hundredths.
  EXPECT_LT(glm::length(mean - 2.0 / 3.0 * area.normal), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ReceiverRaysOf, testing::Bool());

TEST(ReceiverRays, PacketsHoldThePointsOfTheNetInOrder) {
  for (const int rays : {1, 8, 16, 512}) {
    const HemisphereSamples net = make_direction_net(rays);
    ASSERT_EQ(net.points.size(), static_cast<std::size_t>(rays));
    ASSERT_EQ(net.packets.size(), (net.points.size() + packet_size - 1) / packet_size);
    for (std::size_t k = 0; k < net.points.size(); ++k)
      for (std::size_t d = 0; d < 4; ++d)
        EXPECT_EQ(net.packets[k / packet_size].coordinates[d][k % packet_size], net.points[k][d]);
  }
}

} // namespace
} // namespace meninas
