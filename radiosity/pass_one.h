// Pass one: from a scene to the continuous field of irradiance on its diffuse surfaces.
//
//   B_i = E_i + rho_i sum over worlds w of tau_w sum_j F^w_ij B_j       (Eq. 1, on elements)
//   H(x) = D(x) + sum over worlds w of tau_w sum_j F^w_xj B_j           (at the vertices, interpolated between)
//
// Translucent surfaces add tau times H of their other side to B (transport/translucency.h).
// B, E, H in W/m^2. Ideal mirrors are no unknowns: they are in the form factors F^w.
// The unknowns are those of a cut through the hierarchy of elements: its leaves, or nodes as large as
// the light allows (MeshCut), which users get by default.
// The extended radiosity equation: Sillion and Puech 1989, Wallace, Cohen, Greenberg 1987.
#pragma once

#include "radiosity/energy.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/pass_one_settings.h"
#include "radiosity/pass_one_watch.h"

#include <memory>
#include <optional>

namespace meninas {

struct PassOneSeconds {
  double form_factors = 0.0, solve = 0.0, interpolate = 0.0;
};

struct RadiositySolution : ElementSolution {
  IrradianceField field;
  SolverResult solver;              ///< its radiosity is moved out
  std::optional<LinkFigures> links; ///< of a hierarchical mesh
  EnergyBalance energy;
  ClosureError closure;
  PassOneSeconds seconds;
  std::uint64_t form_factor_rays = 0;
  std::uint64_t shadow_rays = 0;
};

/// `progressive` can be watched, and `jacobi` over rows. In scenes of more than `max_direct_unknowns` elements it
/// shoots rays, with no transport in memory (progressive.h), unless the form factors are not by rays;
/// in smaller ones, where they take a few megabytes,
/// blocks shoot by the columns of the transport that the other solvers have, so that all agree.
/// A hierarchical mesh is solved for its nodes (hierarchical/node_solution.h), by rays.
/// Where nothing emits no row is assembled: B = H = 0, and the closure is that of no rows.
RadiositySolution solve_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const Progress& progress = {},
                                 const PassOneWatch& watch = {});

/// Pass one of such a scene is dark, and needs no form factors.
bool nothing_emits(const LightScene& light);

/// The elements that a view shows, by ElementId of the mesh.
struct SeenElements {
  std::vector<std::uint8_t> elements; ///< 1: the element is seen; empty: every one is
  /// Weight of the element's direct light where pass two reads it from the field instead of computing it per
  /// pixel: the largest throughput, in [0, 1], of the paths that read it. Empty: 1 for every one.
  std::vector<float> direct;
};

/// Pass one for one view: elements that it does not show are less exact, and take less time.
/// Light is gathered twice (hierarchical/node_field.h). The first gathering covers the whole scene and gives the
/// light that elements exchange, as exactly as without a view but for direct light of many lamps: at vertices of no
/// seen element at most DirectSettings::images_in_element images tell it, as at an element's points, and beside
/// penumbrae no more samples than elsewhere. The second, with more rays and smaller nodes,
/// covers seen elements only. Shadow edges are refined where pass two reads direct light from the field.
/// So the field is that of the whole solution where it is seen, and elsewhere that of the first gathering or of
/// the solver.
/// Importance-driven radiosity: Smits, Arvo and Salesin 1992.
/// A cut at the leaves is found everywhere, whatever is seen.
RadiositySolution solve_for_view(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const SeenElements& seen,
                                 const Progress& progress = {}, const PassOneWatch& watch = {});

/// Pass one by rays that are shot, whatever the number of elements.
RadiositySolution shoot_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const Progress& progress = {},
                                 const PassOneWatch& watch = {});

/// The same with form factors that are there already (of an earlier run, under other light):
/// only light is found.
RadiositySolution solve_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const FormFactors& factors, const PassOneSettings& settings,
                                 const Progress& progress = {}, const PassOneWatch& watch = {});

} // namespace meninas
