#include "mirror/worlds.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

constexpr double rounding = 1e-12;

struct Mirrors {
  Scene scene;
  SurfaceModel surfaces;
  MirrorSet set;
};

Mirrors mirrors_of(Scene scene) {
  Mirrors mirrors;
  mirrors.scene = std::move(scene);
  mirrors.surfaces = find_surfaces(mirrors.scene);
  mirrors.set = find_mirrors(mirrors.scene, mirrors.surfaces);
  return mirrors;
}

/// A unit room with mirrors at some of x0 x1 y0 y1 z0 z1, and grey walls elsewhere.
Mirrors mirror_room(const std::array<double, 6>& reflectances) {
  Scene scene;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k)
    walls[k] = reflectances[k] > 0.0 ? mirror(reflectances[k]) : diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), walls);
  return mirrors_of(std::move(scene));
}

int deepest(const WorldTree& tree) {
  int depth = 0;
  for (const auto& world : tree.worlds)
    depth = std::max(depth, world.depth);
  return depth;
}

TEST(MirrorWorlds, WithoutMirrorsOnlyTheRealWorld) {
  const WorldTree tree = mirror_worlds(mirror_room({}).set);
  ASSERT_EQ(tree.worlds.size(), 1U);
  EXPECT_EQ(tree.worlds[0].throughput, Rgb(1.0));
  EXPECT_EQ(tree.considered, 0U);
}

TEST(MirrorWorlds, OneMirrorIsOneWorld) {
  const Mirrors mirrors = mirror_room({0.9, 0, 0, 0, 0, 0});
  const WorldTree tree = mirror_worlds(mirrors.set);
  ASSERT_EQ(tree.worlds.size(), 2U);
  EXPECT_DOUBLE_EQ(tree.worlds[1].throughput.r, 0.9);
  EXPECT_LT(
      glm::distance(apply(tree.worlds[1].image, Point3(0.25, 0.5, 0.75)), Point3(-0.25, 0.5, 0.75)),
      rounding);
  EXPECT_EQ(child(tree, real_world, MirrorId{0}), WorldId{1});
  EXPECT_EQ(child(tree, WorldId{1}, MirrorId{0}), none<WorldId>);
  EXPECT_EQ(child(tree, none<WorldId>, MirrorId{0}), none<WorldId>);
}

// Two facing mirrors:
// the depth is the largest k with rho^k >= min_throughput, one chain from either mirror.
TEST(MirrorWorlds, FacingMirrorsAreAsDeepAsTheirThroughput) {
  for (const double rho : {0.3, 0.5, 0.8, 0.9, 0.97}) {
    const Mirrors mirrors = mirror_room({rho, rho, 0, 0, 0, 0});
    const WorldTree tree = mirror_worlds(
        mirrors.set, {.min_throughput = 0.01, .max_depth = 1000, .max_worlds = 10000});
    const int depth = static_cast<int>(std::floor(std::log(0.01) / std::log(rho)));
    EXPECT_EQ(deepest(tree), depth) << rho;
    EXPECT_EQ(tree.worlds.size(), 1U + 2U * static_cast<unsigned>(depth)) << rho;
    EXPECT_EQ(tree.pruned_throughput, 2U) << rho;
    EXPECT_EQ(tree.pruned_limit, 0U) << rho;
    for (const auto& world : tree.worlds)
      EXPECT_NEAR(world.throughput.g, std::pow(rho, world.depth), rounding);
  }
}

// Mirrors at x = 0 and x = 1 show a point x at 2k + x after
// an even number of reflections and at 2k - x after an odd one.
TEST(MirrorWorlds, FacingMirrorsShowTheTextbookImages) {
  const Mirrors mirrors = mirror_room({0.9, 0.9, 0, 0, 0, 0});
  const WorldTree tree =
      mirror_worlds(mirrors.set, {.min_throughput = 0.1, .max_depth = 100, .max_worlds = 1000});
  const Point3 x{0.3, 0.6, 0.2};
  std::vector<double> even, odd, expected_even, expected_odd;
  for (const auto& world : tree.worlds) {
    const Point3 image = apply(world.image, x);
    (world.depth % 2 == 0 ? even : odd).push_back(image.x);
    EXPECT_NEAR(image.y, x.y, rounding);
    EXPECT_NEAR(image.z, x.z, rounding);
    // The last mirror's plane lies between the observer and the image, |k| mirrors away.
    if (world.depth == 0)
      continue;
    EXPECT_GT(signed_distance(world.plane, x), 0.0);
    EXPECT_LT(signed_distance(world.plane, image), 0.0);
  }
  const int depth = deepest(tree);
  for (int k = -depth; k <= depth; ++k) {
    if (2 * std::abs(k) <= depth)
      expected_even.push_back(2 * k + x.x);
    if (std::abs(2 * k - 1) <= depth)
      expected_odd.push_back(2 * k - x.x);
  }
  std::sort(even.begin(), even.end());
  std::sort(odd.begin(), odd.end());
  EXPECT_THAT(even, testing::Pointwise(testing::DoubleNear(rounding), expected_even));
  EXPECT_THAT(odd, testing::Pointwise(testing::DoubleNear(rounding), expected_odd));
}

// Two perpendicular mirrors show three images; the one in the corner is reached by either order.
TEST(MirrorWorlds, ACornerHasADoubleImage) {
  const Mirrors mirrors = mirror_room({0.9, 0, 0, 0, 0.8, 0});
  const WorldTree tree = mirror_worlds(mirrors.set);
  ASSERT_EQ(tree.worlds.size(), 5U);
  const Point3 x{0.3, 0.6, 0.2};
  int doubles = 0;
  for (const auto& world : tree.worlds) {
    if (world.depth != 2)
      continue;
    ++doubles;
    EXPECT_LT(glm::distance(apply(world.image, x), Point3(-0.3, 0.6, -0.2)), rounding);
    EXPECT_NEAR(world.throughput.r, 0.72, rounding);
  }
  EXPECT_EQ(doubles, 2);
}

TEST(MirrorWorlds, MirrorsBackToBackDoNotSeeEachOther) {
  Scene scene;
  add_polygon(scene, "sheet", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
              double_sided(mirror(0.9)));
  const WorldTree tree = mirror_worlds(mirrors_of(std::move(scene)).set);
  EXPECT_EQ(tree.worlds.size(), 3U);
  EXPECT_EQ(tree.considered, 2U);
}

// A sheet of tiles whose corners are off its plane by a hair, to either side, as floats round them. A world of
// both its faces would be the room itself, and lamps in front of the mirror would count twice.
TEST(MirrorWorlds, NorDoRoundedOnes) {
  constexpr int tiles = 12;
  const auto corner = [](int i, int j) {
    const double off = (i + j) % 2 == 0 ? 1e-9 : -1e-9;
    return Point3(-1.0 + 2.0 * i / tiles, 0.4 + 1.6 * j / tiles, -1.6 + off);
  };
  Scene scene;
  add_polygon(scene, "sheet", {corner(0, 0), corner(tiles, 0), corner(tiles, tiles)},
              double_sided(mirror(0.9)));
  Triangle triangle = scene.triangles[0];
  scene.vertices.clear();
  scene.triangles.clear();
  for (int j = 0; j <= tiles; ++j)
    for (int i = 0; i <= tiles; ++i)
      scene.vertices.push_back({.position = corner(i, j)});
  for (std::uint32_t j = 0; j < tiles; ++j)
    for (std::uint32_t i = 0; i < tiles; ++i) {
      const std::uint32_t row = tiles + 1, k = j * row + i;
      triangle.vertices = {VertexId{k}, VertexId{k + 1}, VertexId{k + row + 1}};
      scene.triangles.push_back(triangle);
      triangle.vertices = {VertexId{k}, VertexId{k + row + 1}, VertexId{k + row}};
      scene.triangles.push_back(triangle);
    }
  const Material wall = diffuse(0.7);
  add_room(scene, {-2, 0, -2}, {2, 2.6, 2}, {wall, wall, wall, wall, wall, wall});
  const WorldTree tree = mirror_worlds(mirrors_of(std::move(scene)).set);
  EXPECT_EQ(tree.worlds.size(), 3U);
}

TEST(MirrorWorlds, LimitsLeaveOutTheDeepest) {
  const Mirrors mirrors = mirror_room({0.99, 0.99, 0, 0, 0, 0});
  const WorldTree by_depth =
      mirror_worlds(mirrors.set, {.min_throughput = 0.01, .max_depth = 5, .max_worlds = 1000});
  EXPECT_EQ(by_depth.worlds.size(), 11U);
  EXPECT_EQ(by_depth.pruned_limit, 2U);
  const WorldTree by_count =
      mirror_worlds(mirrors.set, {.min_throughput = 0.01, .max_depth = 500, .max_worlds = 16});
  EXPECT_EQ(by_count.worlds.size(), 17U);
  EXPECT_EQ(deepest(by_count), 8);
  const WorldTree flat =
      mirror_worlds(mirrors.set, {.min_throughput = 0.01, .max_depth = 0, .max_worlds = 16});
  EXPECT_EQ(flat.worlds.size(), 1U);
}

/// Two mirrors at 45 degrees, one above the other, as in a periscope:
/// what comes in at the top goes out at the bottom.
Scene periscope(double height) {
  Scene scene;
  add_polygon(scene, "bottom", {{0, 0, 0}, {0, 1, 1}, {1, 1, 1}, {1, 0, 0}}, mirror(0.9));
  add_polygon(scene, "top",
              {{0, height, 0}, {1, height, 0}, {1, height + 1, 1}, {0, height + 1, 1}},
              mirror(0.9));
  return scene;
}

// Between parallel planes there is no end of images;
// through the windows of a periscope only chains of two can be followed.
TEST(MirrorWorlds, APeriscopeHasNoDeepWorlds) {
  const WorldTree tree =
      mirror_worlds(mirrors_of(periscope(3.0)).set, {.min_throughput = 0.0, .max_depth = 50});
  EXPECT_EQ(deepest(tree), 2);
  EXPECT_EQ(tree.worlds.size(), 5U);
  EXPECT_EQ(tree.pruned_unseen, 2U);
  EXPECT_TRUE(tree.cut.empty());
}

// Whatever was looked at is in the tree or was left out for one reason,
// and every world left out though light reaches it is named.
TEST(MirrorWorlds, TheReportAddsUp) {
  for (const auto& walls : {std::array<double, 6>{0.9, 0.9, 0.5, 0, 0, 0},
                            {0.3, 0.1, 0.2, 0.9, 1, 1},
                            {1, 1, 1, 1, 1, 1},
                            {0, 0, 0.99, 0.99, 0, 0}})
    for (const WorldSettings& settings :
         {WorldSettings{},
          WorldSettings{.min_throughput = 0.1, .max_depth = 4, .max_worlds = 40}}) {
      const WorldTree tree = mirror_worlds(mirror_room(walls).set, settings);
      EXPECT_EQ(tree.considered, tree.worlds.size() - 1 + tree.pruned_unseen +
                                     tree.pruned_throughput + tree.pruned_limit);
      EXPECT_EQ(tree.cut.size(), tree.pruned_throughput + tree.pruned_limit);
      for (const auto& cut : tree.cut)
        EXPECT_EQ(child(tree, cut.parent, cut.mirror), none<WorldId>);
    }
}

TEST(MirrorWorlds, ABlackMirrorOpensNoWorld) {
  const Mirrors mirrors = mirror_room({0.005, 0, 0, 0, 0, 0});
  EXPECT_EQ(mirror_worlds(mirrors.set).worlds.size(), 1U);
}

TEST(MirrorWorlds, ChainsNameTheirMirrorsInOrder) {
  const Mirrors mirrors = mirror_room({0.9, 0.9, 0.9, 0, 0, 0});
  const WorldTree tree = mirror_worlds(mirrors.set);
  for (std::size_t w = 0; w < tree.worlds.size(); ++w) {
    const auto chain = chain_of(tree, static_cast<WorldId>(w));
    ASSERT_EQ(chain.size(), static_cast<std::size_t>(tree.worlds[w].depth));
    WorldId at = real_world;
    Isometry image;
    for (const MirrorId m : chain) {
      at = child(tree, at, m);
      image = compose_reflection(image, mirrors.set.mirrors[index(m)].plane);
    }
    EXPECT_EQ(at, static_cast<WorldId>(w));
    EXPECT_LT(glm::distance(apply(image, Point3(0.1, 0.2, 0.3)),
                            apply(tree.worlds[w].image, Point3(0.1, 0.2, 0.3))),
              rounding);
  }
}

} // namespace
} // namespace meninas::test
