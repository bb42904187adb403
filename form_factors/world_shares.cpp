#include "form_factors/world_shares.h"

#include <algorithm>
#include <tuple>

namespace meninas {

std::uint32_t WorldIndex::child(std::uint32_t parent, MirrorId mirror) {
  const std::uint64_t key = (std::uint64_t{parent} << 32) | index(mirror);
  const auto [place, is_new] = children_.emplace(key, static_cast<std::uint32_t>(entries_.size()));
  if (is_new) {
    const Rgb throughput =
        entries_[parent].throughput * mirrors_.mirrors[index(mirror)].reflectance;
    entries_.push_back({parent, mirror, entries_[parent].depth + 1, throughput});
  }
  return place->second;
}

std::vector<MirrorId> WorldIndex::chain_of(std::uint32_t world) const {
  std::vector<MirrorId> chain;
  for (; world != 0; world = entries_[world].parent)
    chain.push_back(entries_[world].mirror);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

void combine(WorldShares& shares) {
  std::stable_sort(shares.begin(), shares.end(), [](const WalkShare& a, const WalkShare& b) {
    return std::tie(a.world, a.group) < std::tie(b.world, b.group);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (kept > 0 && shares[kept - 1].world == shares[k].world &&
        shares[kept - 1].group == shares[k].group)
      shares[kept - 1].factor += shares[k].factor;
    else
      shares[kept++] = shares[k];
  }
  shares.resize(kept);
}

void append(WorldShares& sum, const WalkResult& point, double weight, WorldIndex& index) {
  // A world is named only where something of it is seen, and then its ancestors as well.
  constexpr std::uint32_t unnamed = 0xffffffffU;
  std::vector<std::uint32_t> names(point.worlds.size(), unnamed);
  names[0] = 0;
  std::vector<std::uint32_t> path;
  for (const WalkShare& share : point.shares) {
    std::uint32_t world = share.world;
    for (; names[world] == unnamed; world = point.worlds[world].parent)
      path.push_back(world);
    for (; !path.empty(); path.pop_back())
      names[path.back()] =
          index.child(names[point.worlds[path.back()].parent], point.worlds[path.back()].mirror);
    sum.push_back({names[share.world], share.group, weight * share.factor});
  }
}

WorldShares difference(const WorldShares& a, const WorldShares& b) {
  WorldShares result = a;
  for (WalkShare share : b) {
    share.factor = -share.factor;
    result.push_back(share);
  }
  combine(result);
  return result;
}

} // namespace meninas
