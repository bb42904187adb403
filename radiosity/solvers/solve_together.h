// The radiosity system for many lamps at once: X_l = S_l + rho T X_l for every lamp l, knowing no geometry.
//
// All right-hand sides go through BiCGStab (solve.h) side by side, each channel of each lamp with
// coefficients of its own, so that a step reads T twice however many lamps there are. Each stops on
// the bound of its own error, G ||r|| <= tolerance ||X_l|| by channel in the maximum norm, G as for
// all light together (error_bound.h): it speaks of the system, not of its source.
//
// Closed parts that absorb nothing reflect nothing, as in solve.h.
// The result is the same for any number of threads.
#pragma once

#include "radiosity/scene/lamp_shares.h"
#include "radiosity/solvers/solve.h"

namespace meninas {

/// `sources` in W/m^2, a row for each unknown; so is the result.
LightByLamp solve_together(const Transport& transport, const LightByLamp& sources,
                           const Scattering& scattering, const SolverSettings& settings = {});

/// rho_i H_i + sum_j tau_ij H_j of all rows and lamps (transport/translucency.h).
LightByLamp scattered(const Scattering& scattering, const LightByLamp& irradiance);

} // namespace meninas
