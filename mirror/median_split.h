// The step of building a tree over things in space: halves of a range, apart where it is longest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace meninas {

/// Puts the half of the members that lie lower along the longest side of the box
/// around their places first: n log n for a tree, never deeper than log n.
/// `places` by member, with `dimensions` coordinates;
/// equal ones go by number. Returns the size of the first half.
template <typename Places>
std::uint32_t split_at_median(std::span<std::uint32_t> members, const Places& places,
                              int dimensions) {
  auto low = places[members[0]], high = low;
  for (const auto m : members)
    for (int k = 0; k < dimensions; ++k) {
      low[k] = std::min(low[k], places[m][k]);
      high[k] = std::max(high[k], places[m][k]);
    }
  int axis = 0;
  for (int k = 1; k < dimensions; ++k)
    if (high[k] - low[k] > high[axis] - low[axis])
      axis = k;
  const auto half = static_cast<std::uint32_t>(members.size() / 2);
  std::nth_element(members.begin(), members.begin() + half, members.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(places[a][axis], a) < std::pair(places[b][axis], b);
                   });
  return half;
}

/// The nodes of a tree over so many members that is divided into halves down to leaves.
inline std::size_t nodes_of_halves(std::size_t members, std::size_t max_in_leaf) {
  std::size_t parts = 1; // of which some have one member more than others
  while (members / parts > max_in_leaf)
    parts *= 2;
  const std::size_t divided = members / parts == max_in_leaf ? members % parts : 0;
  return 2 * (parts + divided) - 1;
}

} // namespace meninas
