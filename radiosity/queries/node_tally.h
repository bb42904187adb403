// The common part of the ray-tracing methods of gltf_node_factors.h: the scene they look light up in, and
// tallies of landings.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"
#include "form_factors/extended_form_factor.h"
#include "radiosity/queries/node_scene.h"

#include <functional>
#include <map>

namespace meninas {

/// The share of the light of A that has arrived, by (set, world), and by set over all worlds.
struct NodeTally {
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Key, double> by_world; ///< sums of tau_w F^w
  std::vector<double> totals;
  double cut = 0.0; ///< the share of the light whose way was not followed to its end
};

/// Adds rays that stand for `share` of A.
void add(const NodeScene& scene, const GatheredRays& gathered, double share, NodeTally& tally);
void add(const NodeTally& part, NodeTally& tally);

/// From the values of several tallies of the same thing to an estimate of it.
using Combine = std::function<Estimate(std::span<const double> values)>;

/// By set, each world's reflectances taken out. The light that was cut adds to the error of the totals.
std::vector<ExtendedFactor>
node_factors_of(const NodeScene& scene, std::span<const NodeTally> tallies, const Combine& combine);

} // namespace meninas
