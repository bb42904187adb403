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

} // namespace meninas
