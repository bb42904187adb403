// Things that are known to belong together, as a forest:
// sets that grow by union, each told by its smallest member.
//
// Paths are halved on the way to the root (Tarjan, van Leeuwen 1984).
// The members of a set, and its root, do not depend on the order of unions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace meninas {

class DisjointSets {
public:
  /// As many sets of one member each.
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t root(std::uint32_t member) {
    while (parent_[member] != member)
      member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parent_;
};

} // namespace meninas
