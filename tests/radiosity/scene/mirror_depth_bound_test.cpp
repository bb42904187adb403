#include "radiosity/transport/hemisphere_rays.h"
#include "radiosity/scene/mirror_depth_bound.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

struct Tail {
  double measured =
      0.0;          ///< mean share of the light of all elements' rays that ends beyond the tree
  double cut = 0.0; ///< mean share of light under way when its ray was cut
  double bound = 0.0;
};

Tail tail_of(Scene scene, const WorldSettings& worlds, int rays) {
  const auto l = lit(std::move(scene), {.element_size = 0.25}, {.mirrors = {}, .worlds = worlds});
  const HemisphereSamples net = make_direction_net(rays);
  GatherWorkspace work;
  Tail tail;
  double area = 0.0;
  for (std::size_t e = 0; e < element_count(l->mesh); ++e) {
    gather_rays(*l->light, net, receiver_of(*l->light, static_cast<ElementId>(e)),
                hash(static_cast<std::uint32_t>(e), 5), {}, work);
    double beyond = 0.0;
    for (const auto& landing : work.result.landings)
      if (landing.world == none<WorldId>)
        beyond += double{landing.light.r};
    tail.measured += l->mesh.area[e] * beyond / rays;
    tail.cut += l->mesh.area[e] * double{work.result.cut_light.r} / rays;
    area += l->mesh.area[e];
  }
  tail.measured /= area;
  tail.cut /= area;
  tail.bound = l->plan.mirror_depth_bound;
  return tail;
}

// Two routes to what lies beyond the tree: where the rays of all elements land,
// and the bound from the windows alone. Between facing mirrors over a whole wall each, bound
// and truth differ by the throughput of the deeper worlds and by the few lines that miss the rest:
// beyond eight reflections 0.17 is left, which 8,192 rays of an element know to 5 %.
TEST(WorldTail, BoundsWhatRaysBringFromBeyondTheTree) {
  for (const double rho : {0.5, 0.9, 0.99, 1.0})
    for (const int depth : {0, 1, 2, 4, 8}) {
      const Tail tail =
          tail_of(facing_mirrors(Rgb(rho)),
                  {.min_throughput = 0.0, .max_depth = depth, .max_worlds = 1000}, 8192);
      EXPECT_LE(tail.measured, 1.02 * tail.bound) << rho << ' ' << depth; // the noise of the rays
      EXPECT_GE(tail.measured, 0.15 * rho * tail.bound) << rho << ' ' << depth;
    }
}

TEST(WorldTail, HoldsForThroughputToo) {
  const Tail tail =
      tail_of(facing_mirrors(Rgb(0.5)), {.min_throughput = 0.1, .max_depth = 1000}, 512);
  EXPECT_LE(tail.measured, 1.02 * tail.bound);
  EXPECT_GT(tail.bound, 0.0);
}

// Perfect mirrors:
// the throughput never falls, the form factor of the windows does, like 1/k^2 for k >> 1.
TEST(WorldTail, FallsWithTheSquareOfTheDepthBetweenPerfectMirrors) {
  const Scene scene = facing_mirrors(Rgb(1.0));
  const SurfaceModel surfaces = find_surfaces(scene);
  const MirrorSet mirrors = find_mirrors(scene, surfaces);
  const double area = receiving_area(scene, surfaces);
  const auto bound = [&](int depth) {
    const WorldTree tree =
        mirror_worlds(mirrors, {.min_throughput = 0.0, .max_depth = depth, .max_worlds = 10'000});
    return mirror_depth_bound(tree, mirrors, area);
  };
  // Between squares k sides apart F = 1/(pi k^2) (1 - O(1/k^2)):
  // depth k ends at windows k sides away, on two sides.
  EXPECT_NEAR(bound(32) / bound(64), 4.0, 0.01);
  EXPECT_NEAR(bound(64) * area, 2.0 / (std::numbers::pi * 64 * 64), 1e-3 * bound(64) * area);
}

// What rays lose between facing mirrors: below 0.99 what is left of a ray at a throughput of 1e-4,
// at 1 what is still under way after 10,000 bounces.
TEST(WorldTail, LittleIsLost) {
  EXPECT_LT(tail_of(facing_mirrors(Rgb(0.99)), {}, 512).cut, 1e-4);
  EXPECT_LT(tail_of(facing_mirrors(Rgb(1.0)), {}, 512).cut, 1e-4);
}

TEST(WorldTail, NothingBeyondASingleMirror) {
  const Scene scene = half_room();
  EXPECT_EQ(plan_transport(scene, find_surfaces(scene)).mirror_depth_bound, 0.0);
}

} // namespace
} // namespace meninas::test
