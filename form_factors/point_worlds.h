// The form factor from a point to faces, through every chain of mirrors, with exact visibility:
//
//   F^w(x, B) = Lambert's factor (point_form_factor.h) of the parts of the image T_w B that x sees
//
// cut by the horizon of x, by the last mirror's plane, by the cones through the visible
// parts of the windows, and by the cones of all blockers on every leg. On leg k the scene
// stands where T_k puts it; what lies there between mirror k and the next one blocks.
// The tree of mirror worlds is walked from x and grows only as far as it can matter:
// all light of a branch passes the visible parts of its window, so tau_w F(x,
// window) bounds whatever the branch can bring. The branch with the largest bound grows first,
// until the bounds of all that is left add up to no more than is asked for:
// facing mirrors of any reflectance end by that, not by a depth.
#pragma once

#include "mirror/mirrors.h"
#include "mirror/reflection.h"
#include "form_factors/visible_parts.h"

#include <cstddef>
#include <vector>

namespace meninas {

/// The scene as form factors see it; refers to objects that outlive it.
struct WorldView {
  const MirrorSet& mirrors;
  const std::vector<Face>& blockers;
  std::vector<Face> targets;
  std::vector<std::uint32_t> groups; ///< by target: what its factors are added up by
  double tolerance = 0.0;            ///< metres; a point that close to a plane sees nothing of it
};

struct WalkSettings {
  double tail = 1e-6;        ///< what may be left out of sum tau_w F^w
  int max_depth = 1'000'000; ///< mirrors a path may meet; what deeper ones bring is not asked for
  std::size_t max_worlds = 100'000; ///< entered from one point, the tail be what it may
};

struct WalkPoint {
  Point3 x;
  Direction normal;
  PlaneId plane_class = none<PlaneId>;
};

/// The chain of a world is that of its parent and `mirror`; world 0 is the real one.
struct WalkedWorld {
  std::uint32_t parent = 0;
  MirrorId mirror = none<MirrorId>;
};

struct WalkShare {
  std::uint32_t world = 0; ///< index into the worlds
  std::uint32_t group = 0;
  double factor = 0.0; ///< F^w, reflectances aside
};

struct WalkResult {
  std::vector<WalkedWorld> worlds;
  std::vector<WalkShare> shares;
  double tail =
      0.0; ///< bound on sum tau_w F^w over all that was left out, tau_w the mean of its channels
  std::size_t work = 0; ///< steps: faces looked at, and parts of them compared with what may hide them
};

/// The mean of the channels: how a colour counts in a total.
inline double mean_of(const Rgb& c) { return (c.r + c.g + c.b) / 3.0; }

/// `known` says, by target, which factors of the real world are not asked for; empty: all are.
WalkResult walk_worlds(const WorldView& view, const WalkPoint& point, const WalkSettings& settings,
                       const std::vector<std::uint8_t>& known);

} // namespace meninas
