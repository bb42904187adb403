// Estimates of the irradiance, W/m^2, from a node of the light tree at a point, or at the points of a small area.
//
// Estimates are rough and never nothing where there is something (light_choice.h); of a node that is
// small for its distance the light from afar is known (emitters.h):
//
//   H = tau I(omega) cos / d^2,
//
// off by up to the square of its radius over its distance: a disc that faces x has r^2 / (d^2 + r^2).
#pragma once

#include "mirror/window_cones.h"

namespace meninas {

/// A world that an observer sees, from where its image of the lamps is where they are themselves.
struct LampView {
  SeenWorld seen;
  Point3 position;
  Direction normal;
  double throughput; ///< of the brightest channel
};

/// Clears and fills `views`, one for each seen world.
void find_views(const WorldTree& worlds, const SeenWorlds& seen, const Observer& observer,
                std::vector<LampView>& views);

struct LightEstimates {
  const WorldTree& worlds;
  const LightTree& tree;
  const Observer& observer;
  const WindowCones& cones; ///< of the worlds that the observer sees
  double extent = 0.0;    ///< estimates hold for all points so far from the observer, m

  /// s, W/m^2 of the brightest channel: the power of the node, spread over what a sphere of its
  /// distance sees of it, with cosines no smaller than any emitter of it has.
  /// 0 only if none of its light arrives.
  double estimate(const LampView& from, std::uint32_t node) const;

  /// Whether a node is small for its distance.
  bool is_small(const LampView& from, std::uint32_t node) const;

  /// Whether it lies above the horizon, behind the last mirror and within one opening.
  bool is_wholly_seen(const LampView& from, std::uint32_t node) const;

  /// The irradiance from a small node, W/m^2 of the brightest channel.
  double light_from_afar(const LampView& from, std::uint32_t node) const;

private:
  Where through_window(const LampView& from, const Vec3& to, double radius) const;
};

} // namespace meninas
