// How much light a node of the light tree brings to a point, or to the points of a small area.
//
// Estimates are rough and never nothing where there is something (light_choice.h); of a node that is
// small for its distance the light from afar is known (emitters.h):
//
//   H = tau I(omega) cos / d^2,
//
// off by about a third of the square of its radius over its distance.
#pragma once

#include "mirror/window_cones.h"

namespace meninas {

struct LightEstimates {
  const WorldTree& worlds;
  const LightTree& tree;
  const Observer& observer;
  const WindowCones& cones; ///< of the worlds that the observer sees
  double extent = 0.0;    ///< estimates hold for all points so far from the observer, m

  /// s, W/m^2 of the brightest channel: the power of the node, spread over what a sphere of its
  /// distance sees of it, with cosines no smaller than any emitter of it has.
  /// 0 only if none of its light arrives.
  double estimate(const SeenWorld& in, std::uint32_t node) const;

  /// Whether a node is small for its distance.
  bool is_small(const SeenWorld& in, std::uint32_t node) const;

  /// Whether it lies above the horizon, behind the last mirror and within one opening.
  bool is_wholly_seen(const SeenWorld& in, std::uint32_t node) const;

  /// What a small node brings, W/m^2 of the brightest channel.
  double light_from_afar(const SeenWorld& in, std::uint32_t node) const;

private:
  double intensity_towards(const MirrorWorld& world, const EmitterNode& node) const;
};

} // namespace meninas
