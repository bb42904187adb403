// Segments through mirrors are blocked or free whichever others are tested with them.
#include "radiosity/light/virtual_light_visibility.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace meninas::test {
namespace {

using Segments = std::array<FoldedSegment, 16>;

/// From one wall to the ceiling's image in any of the worlds.
FoldedSegment any_segment(const LightScene& light, Random& random) {
  const auto worlds = static_cast<double>(light.worlds.worlds.size());
  const auto world = static_cast<WorldId>(static_cast<std::uint32_t>(random.between(0.0, worlds)));
  const Point3 from = random.in_box(Vec3(0.05), Vec3(0.95));
  const Point3 to = random.in_box(Vec3(0.05), Vec3(0.95));
  FoldedSegment segment;
  fold(light, world,
       {from, apply(light.worlds.worlds[index(world)].image, to), none<PlaneId>, none<PlaneId>},
       segment);
  return segment;
}

TEST(ShadowLegs, SegmentsOfAnyNumberOfLegsAreTestedTogether) {
  Scene scene = facing_mirrors(Rgb(0.9));
  add_box(scene, "box", {0.3, 0.0, 0.4}, {0.6, 0.5, 0.6}, diffuse(0.5));
  const auto room = lit(scene, {.element_size = 0.5});
  Random random(3);
  Segments segments, one;
  std::set<std::size_t> legs;
  int free = 0, dark = 0;
  for (int trial = 0; trial < 500; ++trial) {
    for (auto& segment : segments) {
      segment = any_segment(*room->light, random);
      legs.insert(segment.legs.size());
    }
    std::uint64_t rays = 0;
    std::array<LegBlocker, 16> blockers;
    const std::uint32_t together = blocked(*room->light, segments, 16, rays, &blockers);
    for (std::uint32_t k = 0; k < 16; ++k) {
      one[0] = segments[k];
      const bool is_dark = (together >> k & 1U) != 0;
      ASSERT_EQ(blocked(*room->light, one, 1, rays) != 0, is_dark);
      EXPECT_TRUE(!is_dark || blockers[k].leg < segments[k].legs.size());
    }
    dark += std::popcount(together);
    free += 16 - std::popcount(together);
  }
  EXPECT_GE(legs.size(), 4U);
  EXPECT_GT(dark, 500);
  EXPECT_GT(free, 500);
}

TEST(ShadowLegs, RaysAreCountedLegByLeg) {
  const auto room = lit(facing_mirrors(Rgb(0.9)), {.element_size = 0.5});
  Segments segments;
  const LightScene& light = *room->light;
  std::uint64_t legs = 0, rays = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Point3 to = apply(light.worlds.worlds[k].image, Point3(0.5, 0.5, 0.5));
    fold(light, static_cast<WorldId>(k), {{0.4, 0.5, 0.6}, to, none<PlaneId>, none<PlaneId>},
         segments[k]);
    legs += segments[k].legs.size();
  }
  EXPECT_EQ(blocked(light, segments, 3, rays), 0U);
  EXPECT_EQ(rays, legs);
}

} // namespace
} // namespace meninas::test
