#include "mirror/antipenumbra.h"
#include "mirror/worlds.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas::test {
namespace {

constexpr double slack =
    1e-6; // of the sizes, which are 1 to 10: the planes are drawn back by 1e-9 of the largest

ConvexPolygon square(double x, double y, double z, double half) {
  return ConvexPolygon(std::vector<Point3>{{x - half, y - half, z},
                                           {x + half, y - half, z},
                                           {x + half, y + half, z},
                                           {x - half, y + half, z}});
}

double area_of(const ConvexPolygon& polygon) { return glm::length(area_vector(polygon.span())); }

// Lines through two unit squares one above the other spread
// as far behind the second as the squares are apart.
TEST(Penumbra, OfTwoSquares) {
  const ConvexPolygon first = square(0, 0, 0, 0.5), second = square(0, 0, 1, 0.5);
  for (const double z : {1.5, 2.0, 5.0}) {
    const double side = 1.0 + 2.0 * (z - 1.0);
    const ConvexPolygon seen = clip_to_penumbra(square(0, 0, z, 10), first, second);
    EXPECT_NEAR(area_of(seen), side * side, slack * side * side) << z;
  }
}

TEST(Penumbra, OfAWindowBesideTheOther) {
  const ConvexPolygon first = square(0, 0, 0, 0.5), second = square(3, 0, 1, 0.5);
  EXPECT_TRUE(clip_to_penumbra(square(0, 0, 2, 1.0), first, second).empty());
  EXPECT_NEAR(area_of(clip_to_penumbra(square(6, 0, 2, 10), first, second)), 9.0, slack * 9.0);
}

// Nothing that a line through both windows can meet is cut off;
// and what is left is the hull of what lines meet.
TEST(Penumbra, HoldsWhatLinesMeetAndNoMore) {
  Random random(3);
  for (int turn = 0; turn < 40; ++turn) {
    const auto triangle = [&](double z) {
      std::vector<Point3> corners;
      for (int k = 0; k < 3; ++k)
        corners.push_back(random.in_box({-1, -1, z - 0.2}, {1, 1, z + 0.2}));
      return ConvexPolygon(corners);
    };
    const ConvexPolygon first = triangle(0.0), second = triangle(1.0), wall = square(0, 0, 3, 40);
    const ConvexPolygon seen = clip_to_penumbra(wall, first, second);
    Vec2 low(1e9), high(-1e9), seen_low(1e9), seen_high(-1e9);
    for (const auto& a : first.span())
      for (const auto& b : second.span()) {
        const Point3 met = a + (3.0 - a.z) / (b.z - a.z) * (b - a);
        low = glm::min(low, Vec2(met));
        high = glm::max(high, Vec2(met));
      }
    for (const auto& vertex : seen.span()) {
      seen_low = glm::min(seen_low, Vec2(vertex));
      seen_high = glm::max(seen_high, Vec2(vertex));
    }
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(seen_low[axis], std::max(low[axis], -40.0), 1e-5) << turn;
      EXPECT_NEAR(seen_high[axis], std::min(high[axis], 40.0), 1e-5) << turn;
    }
  }
}

TEST(Penumbra, WindowsThatTouchCutNothingTheyShouldNot) {
  // A corner of two windows with a common edge:
  // everything behind the second in front of the first is in sight.
  const ConvexPolygon first(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const ConvexPolygon second(std::vector<Point3>{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}});
  const ConvexPolygon wall(
      std::vector<Point3>{{3, 0.2, 0.1}, {3, 0.8, 0.1}, {3, 0.8, 0.9}, {3, 0.2, 0.9}});
  EXPECT_NEAR(area_of(clip_to_penumbra(wall, first, second)), area_of(wall), 1e-6);
}

/// Mirrors of all sizes and tilts in a box, some of them facing each other.
MirrorSet tilted_mirrors(int count, std::uint32_t seed) {
  Scene scene;
  Random random(seed);
  for (int k = 0; k < count; ++k) {
    const Point3 centre = random.in_box(Vec3(-1.0), Vec3(1.0));
    const Direction u = random.direction();
    const Direction v = glm::normalize(glm::cross(u, random.direction()));
    const double width = random.between(0.3, 0.8), height = random.between(0.3, 0.8);
    add_polygon(scene, "mirror",
                {centre - width * u - height * v, centre + width * u - height * v,
                 centre + width * u + height * v, centre - width * u + height * v},
                double_sided(mirror(0.9)));
  }
  return find_mirrors(scene, find_surfaces(scene));
}

bool inside(const ConvexPolygon& window, const Plane& plane, const Point3& x) {
  for (std::size_t k = 0; k < window.size; ++k) {
    const Point3& a = window.vertices[k];
    const Vec3 edge = window.vertices[(k + 1) % window.size] - a;
    if (glm::dot(glm::cross(edge, x - a), plane.normal) < 0.0)
      return false;
  }
  return true;
}

/// The mirror that a straight ray can pass next as if nothing else were there:
/// any that it meets from the front.
std::vector<std::pair<std::size_t, Point3>> met(const MirrorSet& set, const Point3& x,
                                                const Direction& d) {
  std::vector<std::pair<std::size_t, Point3>> result;
  for (std::size_t m = 0; m < set.mirrors.size(); ++m) {
    const Mirror& mirror = set.mirrors[m];
    const double approach = glm::dot(mirror.plane.normal, d);
    const double t = approach < 0.0 ? -signed_distance(mirror.plane, x) / approach : -1.0;
    if (t > 1e-9 && inside(mirror.window[0], mirror.plane, x + t * d))
      result.emplace_back(m, x + t * d);
  }
  return result;
}

// No ray enters a world that the tree calls unseen.
// And most worlds of the tree are entered by some ray: the rest shows through slits that chance
// does not hit (with twenty times as many rays the share rises from 0.72 to 0.79).
TEST(Penumbra, NoRayEntersAnUnseenWorld) {
  const MirrorSet set = tilted_mirrors(8, 5);
  const WorldTree tree =
      mirror_worlds(set, {.min_throughput = 0.0, .max_depth = 3, .max_worlds = 100'000});
  std::vector<std::uint8_t> entered(tree.worlds.size(), 0);
  Random random(17);

  struct Walker {
    const MirrorSet& set;
    const WorldTree& tree;
    std::vector<std::uint8_t>& entered;
    std::size_t lost = 0;

    void follow(WorldId world, const Point3& x, const Direction& d) {
      if (tree.worlds[index(world)].depth == 3)
        return;
      for (const auto& [m, y] : met(set, x, d)) {
        const WorldId next = child(tree, world, static_cast<MirrorId>(m));
        if (next == none<WorldId>) {
          ++lost;
          continue;
        }
        entered[index(next)] = 1;
        follow(next, y, reflect_direction(set.mirrors[m].plane, d));
      }
    }
  } walker{set, tree, entered};
  for (int k = 0; k < 200'000; ++k) {
    // Rays start anywhere behind the first mirror's front and go through its window.
    const auto& window = set.mirrors[static_cast<std::size_t>(k) % set.mirrors.size()].window[0];
    const double s = random.between(0.0, 1.0), t = random.between(0.0, 1.0);
    const Point3 through = window.vertices[0] + s * (window.vertices[1] - window.vertices[0]) +
                           t * (window.vertices[3] - window.vertices[0]);
    const Direction d = random.direction();
    walker.follow(real_world, through - 0.01 * d, d);
  }
  EXPECT_EQ(walker.lost, 0U);
  EXPECT_GT(tree.pruned_unseen, 0U);
  const auto hit = std::count(entered.begin(), entered.end(), 1);
  EXPECT_GT(double(hit), 0.7 * double(tree.worlds.size() - 1)) << tree.worlds.size();
}

} // namespace
} // namespace meninas::test
