// Pass one by shots (Cohen et al. 1988):
// radiosities without a transport in memory, and what is known of them at any time.
//
// Direct light D and gathered emission G are where light begins to be shot,
// S = rho (D + G) (ARCHITECTURE.md, path table); blocks of elements (shooting_blocks.h) shoot rays
// (ray_shots.h) in Southwell's order (solvers/shooting.h). Memory is linear in elements.
//
// The norm is the power, ||x|| = sum of A |x| over the exposed areas: shots close exactly,
// so that ||B - B_k|| <= kappa G ||U_k|| whatever their rays (shot_bound.h). It bounds what
// further shots would bring; the noise of the rays is not part of it, as it is not with rows.
//
// For display, light that is unshot may be shown as an ambient term:
// spread evenly over all elements, and reflected on and on,
//   H_ambient = sum_j A_j U_j f_j / sum_j A_j / (1 - sum_j A_j rho_j f_j / sum_j A_j),
// with f_j the share of what j shoots that lands on elements, directly or by way of mirrors:
// what escapes or mirrors absorb is lost.
// Where all walls are alike the power shown is that of the solution at any time.
#pragma once

#include "radiosity/solvers/hemisphere_survey.h"
#include "radiosity/solvers/solve.h"

namespace meninas {

/// H_ambient, W/m^2. Exposed areas (m^2), closure, U (W/m^2) and rho by ElementId.
Rgb ambient_irradiance(const std::vector<double>& area, const std::vector<RowClosure>& closure,
                       const std::vector<Rgb>& unshot, const std::vector<Rgb>& reflectance);

struct ShotSolution {
  SolverResult solver; ///< its radiosities are the reflected ones
  std::vector<Rgb> arrived; ///< irradiance by ElementId, W/m^2
  std::uint64_t rays_traced = 0;
};

/// S and rho by ElementId.
struct ShotSource {
  const std::vector<Rgb>& source;
  Scattering scattering;
};
struct ShotSettings {
  const FormFactorSettings& rays;
  const SolverSettings& solver;
};
ShotSolution solve_by_shots(const LightScene& light, const HemisphereSurvey& survey,
                            const ShotSource& from, const ShotSettings& settings,
                            const Progress& progress = {}, const ShotWatch& watch = {});

} // namespace meninas
