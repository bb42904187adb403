// Pass one in one call: from the scene to the continuous field of irradiance, with its figures.
#pragma once

#include "radiosity/hierarchical/link_figures.h"
#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/plan.h"
#include "radiosity/solvers/progressive.h"

namespace meninas {

struct PassOneSettings {
  PlanSettings plan;
  MeshSettings mesh;
  FormFactorSettings form_factors;
  DirectSettings direct;
  SolverSettings solver;
  HierarchicalSettings hierarchical;
  InterpolationSettings interpolation;
};

struct EnergyBalance {
  Rgb emitted{0.0}, absorbed{0.0}, escaped{0.0}, mirror_absorbed{0.0}; ///< W
  double imbalance =
      0.0; ///< (emitted - absorbed - escaped - mirror_absorbed) / emitted, worst channel by size
};

struct ClosureError {
  double mean_error = 0.0; ///< of |1 - (landed + escaped + black + cut)| over the rows
  double max_error = 0.0;
  double cut = 0.0; ///< mean fraction of a row's light cut at the last mirror bounce
};

struct PassOneSeconds {
  double form_factors = 0.0, solve = 0.0, interpolate = 0.0;
};

struct RadiositySolution {
  std::vector<Rgb> radiosity; ///< B by ElementId, emission included: the mean over the exposed part
  std::vector<Rgb> irradiance; ///< H by ElementId, likewise
  std::vector<float> exposed;  ///< by ElementId: the share of the area that is there and on which nothing stands
  IrradianceField field;          ///< on field_scene()
  std::unique_ptr<RefinedScene> refined; ///< adaptive: the scene on the field's mesh
  std::optional<double> interpolation_error; ///< adaptive: estimated, of what its settings bound
  SolverResult solver; ///< its radiosity is moved out
  std::optional<LinkFigures> links; ///< of `hierarchical`
  EnergyBalance energy;
  ClosureError closure;
  PassOneSeconds seconds;
  std::uint64_t form_factor_rays = 0;
  std::uint64_t shadow_rays = 0;
};

/// The scene on the mesh that the field belongs to; `light` is the one that was solved.
inline const LightScene& field_scene(const LightScene& light, const RadiositySolution& solution) {
  return solution.refined ? *solution.refined->light : light;
}

/// Area means of one node over all of its sides;
/// what is covered by things that stand on it receives nothing.
struct NodeLight {
  std::string name;
  double area = 0.0;
  Rgb emitted{0.0}, radiosity{0.0}, irradiance{0.0};
};
std::vector<NodeLight> light_by_node(const Scene& scene, const ElementMesh& mesh,
                                     const RadiositySolution& solution);

/// What shots have brought so far, as a field that averages over elements (interpolation.h),
/// and what the light yet to be shot may add to it.
struct PassOneSoFar {
  int shots = 0;
  IrradianceField field;
  Rgb ambient{0.0}; ///< irradiance, everywhere
};
struct PassOneWatch {
  int every = 0; ///< shots, and after the last; 0: never
  std::function<void(const PassOneSoFar&)> look;
};

/// `progressive` can be watched. In scenes of more than `max_direct_unknowns` elements it shoots
/// rays, with no transport in memory (progressive.h), unless the form factors are not by rays;
/// in smaller ones, where they take a few megabytes,
/// blocks shoot by the columns of the transport that the other solvers have, so that all agree.
/// `hierarchical` solves for nodes (hierarchical/node_solution.h), by rays.
RadiositySolution solve_pass_one(const LightScene& light, const PassOneSettings& settings,
                                 const Progress& progress = {}, const PassOneWatch& watch = {});

/// Whether these settings shoot rays instead of assembling a transport.
bool shoots_rays(const PassOneSettings& settings, std::size_t elements);

/// Whether light is received by nodes,
/// and vertices gather as far as these ask for it (hierarchical/node_field.h).
bool gathers_by_nodes(const PassOneSettings& settings);

/// Pass one by rays that are shot, whatever the number of elements.
RadiositySolution shoot_pass_one(const LightScene& light, const PassOneSettings& settings,
                                 const Progress& progress = {}, const PassOneWatch& watch = {});

/// The same with form factors that are there already (of an earlier run, under other light):
/// only light is found.
RadiositySolution solve_pass_one(const LightScene& light, const FormFactors& factors,
                                 const PassOneSettings& settings, const Progress& progress = {},
                                 const PassOneWatch& watch = {});

} // namespace meninas
