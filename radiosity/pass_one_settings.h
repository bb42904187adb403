// What pass one is asked for: the settings of each of its stages in one place.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/hierarchical/link_figures.h"
#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/plan.h"
#include "radiosity/solvers/solver_settings.h"
#include "radiosity/transport/form_factors.h"

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

/// Whether these settings shoot rays instead of assembling a transport.
bool shoots_rays(const PassOneSettings& settings, std::size_t elements);

/// Whether light is received by nodes,
/// and vertices gather as far as these ask for it (hierarchical/node_field.h).
bool gathers_by_nodes(const PassOneSettings& settings);

} // namespace meninas
