// Mirror worlds: the tree of images of the room under chains of reflections
// (Wallace, Cohen, Greenberg 1987).
//
// World 0 is the real room. The world of the chain w = (m1 ...
// mk) is a child of (m1 ... mk-1): what is seen by way of m1 first.
// All of it is laid out in the unfolded space of the observer:
// `image` maps real points there (T_w = R_m1 ... R_mk), `window` and `plane` are the last mirror's,
// placed in the parent's world and cut where an earlier mirror's plane ends that world.
// tau_w is the product of the reflectances.
//
// The tree holds the worlds worth a closed form.
// A chain that no straight line can follow through all of its windows is no world.
// The others are opened breadth first while their throughput is at least `min_throughput`,
// their depth at most `max_depth` and their number at most `max_worlds`;
// behind them those with a coat in their chain, by a number of their own.
// Worlds that are cut lose no light: rays go on through mirrors and carry it
// (radiosity/scene/mirror_depth_bound.h says how much that can be).
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
  int max_coat_worlds = 32; ///< besides, with a coat in their chain
};

struct MirrorWorld {
  WorldId parent = none<WorldId>;
  MirrorId mirror = none<MirrorId>; ///< the last mirror of the chain
  int depth = 0;
  Rgb throughput{1.0};
  Isometry image; ///< real room -> unfolded space
  Plane plane;    ///< of the last mirror in unfolded space, normal towards the observer
  std::vector<ConvexPolygon> window; ///< of the last mirror in unfolded space
  std::vector<MirrorId> chain;       ///< first one first
};

/// A world that light reaches but that is not in the tree.
struct CutWorld {
  WorldId parent = none<WorldId>;
  MirrorId mirror = none<MirrorId>;
  Rgb throughput{1.0};
};

struct WorldTree {
  std::vector<MirrorWorld> worlds; ///< [0] is the real world
  std::vector<std::vector<WorldId>>
      children; ///< by world, then by mirror: none where there is no such world
  // Children of worlds in the tree:
  // considered = worlds in the tree but the real one + the three below.
  std::size_t considered = 0;
  std::size_t pruned_unseen = 0;     ///< no line passes all windows of the chain
  std::size_t pruned_throughput = 0; ///< below min_throughput
  std::size_t pruned_limit = 0;      ///< beyond max_depth or max_worlds
  std::vector<CutWorld> cut;         ///< the latter two
};

WorldTree mirror_worlds(const MirrorSet& mirrors, const WorldSettings& settings = {});

inline WorldId child(const WorldTree& tree, WorldId world, MirrorId mirror) {
  if (world == none<WorldId> || mirror == none<MirrorId>)
    return none<WorldId>;
  return tree.children[index(world)][index(mirror)];
}

/// The images of a mirror's window and plane in a world, as an observer in the real room sees them.
/// The window is without what lies on the observer's side of that world's own mirror.
std::vector<ConvexPolygon> window_in_world(const MirrorWorld& world, const Mirror& mirror);

/// The mirrors of the chain, first one first.
inline const std::vector<MirrorId>& chain_of(const WorldTree& tree, WorldId world) {
  return tree.worlds[index(world)].chain;
}

} // namespace meninas
