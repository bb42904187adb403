// Two packets of eight find what one of sixteen finds, to the bit, holes in the packet included.
#include "scenes/rays/embree_handles.h"
#include "scenes/rays/ray_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <random>

namespace meninas {
namespace {

TEST(PacketWidth, EightAndSixteenFindTheSameHits) {
  std::array<Material, 6> walls;
  walls.fill(test::diffuse(0.5));
  Scene scene;
  test::add_room(scene, {0, 0, 0}, {2, 3, 4}, walls);
  test::add_room(scene, {0.5, 0.5, 0.5}, {1.2, 1.1, 1.3}, walls); // half of it is in the way
  const SurfaceModel surfaces = find_surfaces(scene);
  const RayScene rays = make_ray_scene(scene, surfaces);
  const RTCScene embree = rays.impl().scene.get();
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> within(-0.4F, 0.4F);
  int met = 0;
  for (int round = 0; round < 500; ++round) {
    RTCRayHit16 sixteen;
    std::memset(&sixteen, 0, sizeof sixteen);
    alignas(64) std::int32_t valid[packet_size];
    for (std::size_t k = 0; k < packet_size; ++k) {
      valid[k] = engine() % 4 == 0 ? 0 : -1;
      for (float* each : {sixteen.ray.org_x, sixteen.ray.org_y, sixteen.ray.org_z,
                          sixteen.ray.dir_x, sixteen.ray.dir_y, sixteen.ray.dir_z})
        each[k] = within(engine);
      sixteen.ray.tnear[k] = valid[k] == 0 ? std::numeric_limits<float>::infinity() : 0.0F;
      sixteen.ray.tfar[k] = valid[k] == 0 ? 0.0F : std::numeric_limits<float>::infinity();
      sixteen.ray.mask[k] = ~0U;
      sixteen.hit.geomID[k] = sixteen.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCRayHit16 eight = sixteen;
    QueryContext context;
    init_context(context, Coherence::incoherent, nullptr);
    trace({embree, PacketWidth::sixteen}, valid, context, sixteen);
    trace({embree, PacketWidth::eight}, valid, context, eight);
    for (std::size_t k = 0; k < packet_size; ++k) {
      EXPECT_EQ(eight.hit.primID[k], sixteen.hit.primID[k]);
      EXPECT_EQ(eight.ray.tfar[k], sixteen.ray.tfar[k]);
      EXPECT_EQ(eight.hit.u[k], sixteen.hit.u[k]);
      EXPECT_EQ(eight.hit.v[k], sixteen.hit.v[k]);
      met += sixteen.hit.primID[k] != RTC_INVALID_GEOMETRY_ID;
    }
  }
  EXPECT_GT(met, 3000);
}

} // namespace
} // namespace meninas
