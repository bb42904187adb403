// Eq. 1 (pass_one.h) on the elements, for the part of the light that they reflect:
//
//   X = rho (D + G) + rho T X,      H = D + G + T X,      B = E + X        W/m^2, by ElementId
//
// and of translucent surfaces with tau times what their other side receives (transport/translucency.h),
// with D + G the light that no element has reflected yet (light/first_light.h) and
// T = sum over worlds w of tau_w F^w. It is solved in one of three ways:
//
//   rows     T is assembled row by row and the system solved (transport/form_factors.h, solvers/solve.h)
//   shots    nothing of T is kept: elements shoot rays (solvers/progressive.h)
//   nodes    T between nodes that stand for many elements (hierarchical/node_solution.h)
#pragma once

#include "radiosity/hierarchical/receiver_nodes.h"
#include "radiosity/light/first_light.h"
#include "radiosity/pass_one_settings.h"
#include "radiosity/pass_one_watch.h"

#include <optional>

namespace meninas {

struct ReflectedLight {
  FirstLight first;         ///< D + G
  SolverResult solver;      ///< its radiosity is X
  std::vector<Rgb> arrived; ///< T X
  LightByLamp by_lamp, irradiance_by_lamp; ///< X and H of each lamp; empty where light is not told apart
  std::vector<RowClosure> closure; ///< of the elements' own rays
  std::vector<float> exposed;      ///< the share of the area that is there and on which nothing stands
  std::optional<HierarchicalSolution> receivers; ///< of nodes, where vertices gather by them
  std::optional<LinkFigures> links;              ///< of nodes
  std::uint64_t rays_traced = 0;
  double form_factor_seconds = 0.0, solve_seconds = 0.0; ///< first light is in the former
};

/// `factors` are those of the scene, also of an earlier run under other light.
/// Watched while the solver is `progressive`, which shoots by their columns, or `jacobi`, whose sweeps count as shots.
ReflectedLight reflected_by_rows(const LightScene& light, const FormFactors& factors,
                                 const PassOneSettings& settings, const Progress& progress,
                                 const PassOneWatch& watch);

/// In the way that the settings ask for: shots where there are too many elements for rows (shoots_rays), nodes on a
/// hierarchical cut, else rows.
/// `seen` as of reflected_by_nodes().
ReflectedLight reflected_light(const LightScene& light, const PassOneSettings& settings,
                               const Progress& progress, const PassOneWatch& watch,
                               std::span<const std::uint8_t> seen = {});

ReflectedLight reflected_by_shots(const LightScene& light, const PassOneSettings& settings,
                                  const Progress& progress, const PassOneWatch& watch);

/// `seen` by ElementId (SeenElements); empty: every one is. Direct light at vertices of none that is seen is that
/// of fewer emitters' images: DirectSettings::images_in_element.
ReflectedLight reflected_by_nodes(const LightScene& light, const PassOneSettings& settings,
                                  const Progress& progress,
                                  std::span<const std::uint8_t> seen = {});

} // namespace meninas
