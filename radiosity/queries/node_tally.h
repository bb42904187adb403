// What the methods of node_form_factors.h that trace rays share:
// the scene they look light up in, and tallies of landings.
#pragma once

#include "radiosity/transport/gather_rays.h"
#include "radiosity/queries/node_form_factors.h"

#include <functional>
#include <map>

namespace meninas {

/// Where rays are to land: on those sides of those sets of nodes.
struct AskedSides {
  std::span<const NodeSet> nodes;
  NodeSides sides = NodeSides::facing;
};

/// One element for each side: enough to know whose it is.
/// A mirror's landing is known by its table.
struct NodeScene {
  NodeScene(const Scene& scene, const SurfaceModel& surfaces, const MirrorSet& mirrors,
            const AskedSides& to, int max_depth);
  NodeScene(const NodeScene&) = delete;
  NodeScene& operator=(const NodeScene&) = delete;

  std::size_t group_count;
  ElementMesh mesh;
  std::vector<std::uint32_t> groups; ///< by SideId: the place of its set among those asked for
  RayScene rays;
  WorldTree worlds;
  LightScene light;
  FormFactorSettings settings;
};

/// Throws UsageError when nothing can land on one of the sets.
void require_landings(const NodeScene& scene, const AskedSides& to);

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

/// By set, each world's reflectances taken out. What was cut adds to the error of the totals.
std::vector<ExtendedFactor>
node_factors_of(const NodeScene& scene, std::span<const NodeTally> tallies, const Combine& combine);

} // namespace meninas
