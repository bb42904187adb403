// Very many nearly equal planes: what is looked at stays bounded, and the planes that are known best
// are still found.
#include "scenes/neighbour_grid.h"
#include "scenes/surfaces.h"
#include "tests/scenes/soup.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace meninas::test {
namespace {

TEST(CrowdedPlanes, ACellKnowsThoseThatCameFirst) {
  constexpr std::uint32_t most = 16;
  NeighbourGrid<2> grid(1.0, 2000, most);
  for (std::uint32_t k = 0; k < 1000; ++k) {
    grid.add({0.5, 0.5}, k);
    grid.add({5.5, 0.5}, k); // the crowd in one cell is not that of another
  }
  for (const double x : {0.5, 5.5}) {
    std::vector<std::uint32_t> seen;
    grid.visit_near({x, 0.5}, 0.25, [&](std::uint32_t item) {
      seen.push_back(item);
      return true;
    });
    std::vector<std::uint32_t> first(most);
    for (std::uint32_t k = 0; k < most; ++k) {
      first[k] = k;
    }
    EXPECT_EQ(seen, first);
  }
}

TEST(CrowdedPlanes, WithoutALimitAllAreKnown) {
  NeighbourGrid<2> grid(1.0, 1000);
  for (std::uint32_t k = 0; k < 1000; ++k) {
    grid.add({0.5, 0.5}, k);
  }
  std::size_t seen = 0;
  grid.visit_near({0.5, 0.5}, 0.25, [&](std::uint32_t) { return ++seen > 0; });
  EXPECT_EQ(seen, 1000U);
}

/// A triangle of a millimetre whose middle is `middle`, of a plane with normal (tilt.x, tilt.y, 1).
void add_chip(Scene& scene, const Point3& middle, const Vec2& tilt) {
  std::array<Point3, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = k == 1 ? 1e-3 : k == 2 ? -0.5e-3 : 0.0, y = k == 2 ? 1e-3 : -0.5e-3;
    corners[k] = middle + Vec3(x, y, -tilt.x * x - tilt.y * y);
  }
  add_triangle(scene, corners);
}

TEST(CrowdedPlanes, ChipsOfAWallShareItsPlaneInACrowdOfChipsThatDoNot) {
  Scene scene = empty_soup();
  scene.position_error = 1e-7; // that of floats, metres from the origin
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> place(-2.0, 2.0), off(0.001, 0.02), tilt(-0.01, 0.01);
  constexpr std::size_t crowd = 3000, chips = 50;
  for (std::size_t k = 0; k < crowd; ++k) {
    add_chip(scene, {place(chance), place(chance), off(chance)}, {tilt(chance), tilt(chance)});
  }
  add_quad(scene, {Point3(-2, -2, 0), {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  for (std::size_t k = 0; k < chips; ++k) {
    // Beside the wall, so that they are no part of its surface.
    add_chip(scene, {3.0 + place(chance) / 4.0, place(chance), 0.0}, Vec2(0.0));
  }
  const SurfaceModel model = find_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), crowd + 1 + chips);
  const PlaneId wall = model.surfaces[crowd].plane_class;
  for (std::size_t k = 0; k < chips; ++k) {
    EXPECT_EQ(model.surfaces[crowd + 1 + k].plane_class, wall) << "chip " << k;
  }
  // The crowd lies in planes of its own.
  for (std::size_t k = 0; k < crowd; ++k) {
    ASSERT_NE(model.surfaces[k].plane_class, wall) << "chip " << k;
  }
}

} // namespace
} // namespace meninas::test
