// Very many items in one place: what is looked at stays bounded, and those that came first, of planes
// the ones that are known best, are still found.
#include "scenes/neighbour_grid.h"

#include <gtest/gtest.h>

#include <vector>

namespace meninas::test {
namespace {

TEST(CrowdedGrid, ACellKnowsThoseThatCameFirst) {
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

TEST(CrowdedGrid, WithoutALimitAllAreKnown) {
  NeighbourGrid<2> grid(1.0, 1000);
  for (std::uint32_t k = 0; k < 1000; ++k) {
    grid.add({0.5, 0.5}, k);
  }
  std::size_t seen = 0;
  grid.visit_near({0.5, 0.5}, 0.25, [&](std::uint32_t) { return ++seen > 0; });
  EXPECT_EQ(seen, 1000U);
}

} // namespace
} // namespace meninas::test
