#include "radiosity/transport/ray_comb.h"
#include "radiosity/transport/hemisphere_rays.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

std::vector<MirroredRay> rays_of(std::size_t count) {
  std::vector<MirroredRay> rays(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    rays[k].number = k;
    rays[k].weight = 0.5F + static_cast<float>(k % 3);
    rays[k].throughput = glm::vec3(1.0F / (1.0F + static_cast<float>(k % 3)));
  }
  return rays;
}

double weight_of(const std::vector<MirroredRay>& rays) {
  double sum = 0.0;
  for (const MirroredRay& ray : rays)
    sum += double{ray.weight};
  return sum;
}

double light_of(const std::vector<MirroredRay>& rays) {
  double sum = 0.0;
  for (const MirroredRay& ray : rays)
    sum += double{ray.weight} * double{ray.throughput.r};
  return sum;
}

TEST(RayComb, LeavesRaysAloneThatAreFewEnough) {
  for (const std::size_t bounces : {1, 64, 65, 128}) {
    const std::size_t count = bounces <= 64 ? 1000 : 64 * 1000 / bounces;
    std::vector<MirroredRay> rays = rays_of(count);
    comb_rays(rays, {bounces, 1000}, 7);
    EXPECT_EQ(rays.size(), count) << bounces;
  }
}

// Weights here are sums of halves: exact.
TEST(RayComb, KeepsAllWeightAndHalfOfTheRaysInTheirOrder) {
  for (const std::size_t count : {2, 3, 100, 101}) {
    std::vector<MirroredRay> rays = rays_of(count);
    comb_rays(rays, {10'000, 16}, 7);
    EXPECT_EQ(rays.size(), (count + 1) / 2);
    EXPECT_EQ(weight_of(rays), weight_of(rays_of(count)));
    for (std::size_t k = 0; k < rays.size(); ++k)
      EXPECT_EQ(rays[k].number / 2, k);
  }
}

// Heavy rays are dim here: a choice that did not go by weight would change the mean. The light of a seed has a standard
// deviation of 7 %, so the mean over 20,000 seeds is known to 0.05 %; four times that is allowed.
TEST(RayComb, KeepsTheLightInTheMean) {
  constexpr std::uint32_t seeds = 20'000;
  double sum = 0.0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    std::vector<MirroredRay> rays = rays_of(30);
    comb_rays(rays, {10'000, 16}, seed);
    sum += light_of(rays) / seeds;
  }
  EXPECT_NEAR(sum / light_of(rays_of(30)), 1.0, 2e-3);
}

/// A closed room of mirrors, with a spot on its floor that one ray in some million meets.
std::unique_ptr<LitScene> closed_mirrors(double reflectance) {
  Scene scene;
  const Material glass = mirror(reflectance);
  add_room(scene, Point3(0.0), Point3(1.0, 1.1, 1.2), {glass, glass, glass, glass, glass, glass});
  const double size = 1e-3, low = 1e-2;
  add_polygon(scene, "spot", {{0.4, low, 0.4}, {0.4, low, 0.4 + size}, {0.4 + size, low, 0.4 + size}, {0.4 + size, low, 0.4}},
              diffuse(0.5, 1.0));
  return lit(std::move(scene), {.element_size = 0.25});
}

GatheredRays gathered_at_spot(double reflectance) {
  const auto scene = closed_mirrors(reflectance);
  const HemisphereSamples net = make_direction_net(64);
  GatherWorkspace work;
  gather_rays(*scene->light, net, receiver_of(*scene->light, ElementId{0}), 5, {}, work);
  return work.result;
}

// Each ray is followed to its end, ten thousand bounces away, were there no comb: 640,000 legs.
TEST(RayComb, BoundsTheLegsBetweenMirrorsThatLetNothingOut) {
  const GatheredRays met = gathered_at_spot(1.0);
  EXPECT_LE(met.traced, 64 * 391U);
  EXPECT_EQ(met.landed + met.escaped + met.black + met.cut, 64.0);
  EXPECT_GT(met.cut, 60.0);
}

// Mirrors that absorb have all light in the end, but for the ten-thousandth at which a ray is left: then, weights are as they were.
TEST(RayComb, LosesNoLightToMirrorsThatAbsorb) {
  const GatheredRays met = gathered_at_spot(0.99);
  EXPECT_LE(met.traced, 64 * 240U);
  EXPECT_NEAR(double{met.mirror_absorbed.r}, 64.0, 0.01);
}

} // namespace
} // namespace meninas::test
