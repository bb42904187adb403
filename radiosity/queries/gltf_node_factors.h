// Form factors between the nodes of a scene, in total and per mirror world:
// the radiosity side of `meninas formfactors`.
//
// From sides of all faces of A that are no mirrors, weighted by area,
// to sides of all faces of B, each a node or all nodes of a group:
//   F = sum_w tau_w F^w,  tau_w the mean of the channels of the product of the mirrors' reflectances, F^w geometric.
// `analytic` is extended_form_factor.h. `rays` follows cosine-distributed rays
// (hemisphere_rays.h) from points spread over A in sixteen independent replicas:
// their scatter is the standard error, and the share of one ray the least.
// `hemicube` sets hemicubes in the middle of equal pieces of A (hemicube.h):
// its error estimate adds up twice what half the resolution changes, four times what four
// times as many pieces change, and what no cell may have met. It covers most errors,
// not those of features of A finer than its pieces, such as the rim of a gap of a thousandth.
#pragma once

#include "form_factors/extended_form_factor.h"
#include "mirror/mirrors.h"
#include "radiosity/queries/node_sets.h"

#include <span>
#include <string>

namespace meninas {

enum class NodeFactorMethod { analytic, rays, hemicube };

struct NodeFactorSettings {
  NodeFactorMethod method = NodeFactorMethod::analytic;
  NodeSides sides = NodeSides::facing;
  double accuracy = 1e-4;    ///< analytic: wanted relative error
  int rays = 1 << 20;        ///< rays: in all, about
  int resolution = 128;      ///< hemicube: cells along an edge of the top, even
  int points = 64;           ///< hemicube: pieces of A, about
  int max_depth = 1'000'000; ///< mirrors a path may meet
  std::uint32_t seed = 0;
};

struct NodeFactors {
  double area = 0.0;              ///< of A's sides that count, m^2
  double fronts = 0.0, backs = 0.0; ///< the parts of it
  std::vector<ExtendedFactor> to; ///< by set of nodes asked for
  MirrorSet mirrors;              ///< chains refer to it
  bool converged = true;          ///< analytic: the accuracy was reached
  std::vector<std::string> not_counted; ///< what of A and B is not, where it matters, a line each
};

/// Throws UsageError when `from` has no side that scatters light, or a set asked for has no face.
NodeFactors node_form_factors(const Scene& scene, const SurfaceModel& surfaces, const NodeSet& from,
                              std::span<const NodeSet> to, const NodeFactorSettings& settings = {});

/// The total and its standard error by rays; `mirrors` as for the analytic method.
std::vector<ExtendedFactor> ray_form_factors(const Scene& scene, const SurfaceModel& surfaces,
                                             const MirrorSet& mirrors,
                                             const std::vector<Face>& from,
                                             std::span<const NodeSet> to,
                                             const NodeFactorSettings& settings);

/// The same by hemicubes.
std::vector<ExtendedFactor> hemicube_form_factors(const Scene& scene, const SurfaceModel& surfaces,
                                                  const MirrorSet& mirrors,
                                                  const std::vector<Face>& from,
                                                  std::span<const NodeSet> to,
                                                  const NodeFactorSettings& settings);

} // namespace meninas
