// Mirror worlds: the tree of images of the room under chains of reflections (DESIGN 4).
//
// World 0 is the real room. The world of the chain w = (m1 ... mk) is a child of (m1 ... mk-1): what is seen by way of m1 first.
// All of it is laid out in the unfolded space of the observer: `image` maps real points there (T_w = R_m1 ... R_mk), `window`
// and `plane` are the last mirror's, placed in the parent's world and cut where an earlier mirror's plane ends that world.
// tau_w is the product of the reflectances.
//
// The tree holds the worlds worth a closed form: throughput at least `min_throughput`, depth at most `max_depth`, at most
// `max_worlds`, breadth first. Nothing is lost beyond it: rays go on through mirrors and carry what deeper worlds throw.
#pragma once

#include "mirror/mirrors.h"
#include "mirror/reflection.h"

#include <vector>

namespace meninas {

enum class WorldId : std::uint32_t {};
inline constexpr WorldId real_world{0};

struct WorldSettings {
  double min_throughput = 0.01;
  int max_depth = 8;
  int max_worlds = 128;
};

struct MirrorWorld {
  WorldId parent = none<WorldId>;
  MirrorId mirror = none<MirrorId>; ///< the last mirror of the chain
  int depth = 0;
  Rgb throughput{1.0};
  Isometry image; ///< real room -> unfolded space
  Plane plane;    ///< of the last mirror in unfolded space, normal towards the observer
  std::vector<ConvexPolygon> window; ///< of the last mirror in unfolded space
};

struct WorldTree {
  std::vector<MirrorWorld> worlds; ///< [0] is the real world
  std::vector<std::vector<WorldId>>
      children; ///< by world, then by mirror: none where there is no such world
  std::size_t considered = 0;
  std::size_t pruned_unseen = 0;     ///< the window cannot be seen through the ones before
  std::size_t pruned_throughput = 0; ///< below min_throughput
  std::size_t pruned_limit = 0;      ///< beyond max_depth or max_worlds: followed by rays alone
};

WorldTree mirror_worlds(const MirrorSet& mirrors, const WorldSettings& settings = {});

inline WorldId child(const WorldTree& tree, WorldId world, MirrorId mirror) {
  if (world == none<WorldId> || mirror == none<MirrorId>)
    return none<WorldId>;
  return tree.children[index(world)][index(mirror)];
}

/// The mirrors of the chain, first one first.
std::vector<MirrorId> chain_of(const WorldTree& tree, WorldId world);

} // namespace meninas
