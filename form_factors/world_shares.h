// Factors by mirror world and group, gathered from many points:
// each point knows the worlds it has walked, here they get common names.
#pragma once

#include "form_factors/point_worlds.h"

#include <unordered_map>

namespace meninas {

/// Worlds by chain, in the order in which they were first met.
class WorldIndex {
public:
  explicit WorldIndex(const MirrorSet& mirrors) : mirrors_(mirrors) { entries_.push_back({}); }

  struct Entry {
    std::uint32_t parent = 0;
    MirrorId mirror = none<MirrorId>;
    int depth = 0;
    Rgb throughput{1.0};
  };

  std::uint32_t child(std::uint32_t parent, MirrorId mirror);
  const Entry& operator[](std::uint32_t world) const { return entries_[world]; }
  std::size_t size() const { return entries_.size(); }
  std::vector<MirrorId> chain_of(std::uint32_t world) const;

private:
  const MirrorSet& mirrors_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint64_t, std::uint32_t> children_;
};

/// A sparse vector over (world, group): sorted, each once.
using WorldShares = std::vector<WalkShare>;

/// Sorts and adds up what belongs to the same world and group.
void combine(WorldShares& shares);

/// Appends weight times the shares of one point.
void append(WorldShares& sum, const WalkResult& point, double weight, WorldIndex& index);

/// a - b of combined shares.
WorldShares difference(const WorldShares& a, const WorldShares& b);

} // namespace meninas
