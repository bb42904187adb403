#include "mirror/median_split.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

std::size_t counted(std::size_t members, std::size_t max_in_leaf) {
  return members <= max_in_leaf ? 1
                                : 1 + counted(members / 2, max_in_leaf) +
                                      counted(members - members / 2, max_in_leaf);
}

TEST(MedianSplit, NodesOfHalvesAreThoseThatDividingMakes) {
  for (std::size_t max_in_leaf = 1; max_in_leaf < 6; ++max_in_leaf)
    for (std::size_t members = 1; members < 3000; ++members)
      ASSERT_EQ(nodes_of_halves(members, max_in_leaf), counted(members, max_in_leaf))
          << members << ' ' << max_in_leaf;
}

} // namespace
} // namespace meninas::test
