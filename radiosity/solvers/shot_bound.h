// A bound of the light that further shots can bring, and the test whether they would ever end, from the
// elements' own rays.
//
// A unit of power that j shoots makes, with all that it becomes,
// the power h_j = 1 + sum_i F_ji rho_i h_i. So with q_m = (F rho)^m 1,
//   ||B - B_k|| <= kappa G ||U_k||,   kappa = ||q_1||,   G = ||h|| <= ||q_0 + ... + q_(m-1)|| / (1 - ||q_m||)  for any m
// in the power norm of what is shot and the maximum norm of the rest: error_bound.h, transposed.
// m = 1 gives 1 / (1 - kappa). Where some elements see hardly anything but bright
// walls the rays are traced again for a larger m, until that is no better.
// Only what may ever shoot counts: elements that reflect, of parts of the scene that have light.
//
// Parts whose elements lose none of their light are traps: in them light would grow without end. They reflect
// nothing, as in solve.h, and where all light is in them there is no solution.
#pragma once

#include "radiosity/solvers/hemisphere_survey.h"
#include "radiosity/solvers/solve.h"

namespace meninas {

/// By channel.
struct ShotBound {
  Rgb kept{0.0};          ///< kappa
  Rgb amplification{1.0}; ///< G; infinite where none was found
  std::vector<Rgb> open;  ///< by ElementId: 0 in traps with light, 1 elsewhere; empty where there are none
  std::vector<std::uint32_t> trapped; ///< elements with light in a trap
  bool unsolvable = false;            ///< all light is in traps
  std::uint64_t rays_traced = 0;
};

/// Source S and what scatters are by ElementId; translucent surfaces count with all that they scatter.
ShotBound bound_of_shots(const LightScene& light, const HemisphereSurvey& survey,
                         const FormFactorSettings& rays, const std::vector<Rgb>& source,
                         const Scattering& scattering);

} // namespace meninas
