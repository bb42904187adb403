// Solves the radiosity system  B = S + rho T B  (Eq. 1 with the direct light in the source S), knowing no geometry.
//
// Input: source in W/m^2, reflectance dimensionless, transport rows T >= 0.
// Output: B in W/m^2, by ElementId.
//   direct        dense LU of 1 - rho T, for at most `max_direct_unknowns`: the oracle of the others
//   jacobi        B_{k+1} = S + rho T B_k: one bounce of light a sweep
//   gauss-seidel  the same, in 32 steps that use what the steps before have found
//   cg            a Krylov method that needs neither areas nor symmetry, which sampled form factors lack: BiCGStab (van der
//                 Vorst 1992).
//                 Conjugate gradients on the symmetrised system are no faster (docs/notes/solvers.md).
//   progressive   shooting by columns, the largest unshot power first (solvers/shooting.h). In large scenes pass one shoots rays instead,
//                 and stores no transport (progressive.h).
// The unknowns are elements, or the nodes of a hierarchical mesh (hierarchical/node_solution.h).
// All stop on one bound of the error (solvers/error_bound.h):
// with the residual r_k = S + rho T B_k - B_k,
//   ||B - B_k|| <= G ||r_k|| <= tolerance ||B_k||    in the maximum norm, for every channel.
// That norm is of the brightest spot. Where areas are known, all but shots and watched sweeps go on until
// |B - B_k| / B_k is at most ten tolerances in the mean over area (relative_error()).
// None returns less than S, and so nothing negative:
// light only adds to what is there without bounces.
// In a closed part of the scene that absorbs nothing light would grow without end: that is found out beforehand,
// such parts reflect nothing, and the result says how many unknowns they have. Where all light is in them
// there is no solution: B = S is returned and the end says so.
// Grey systems are solved in one band. Deterministic for any thread count.
#pragma once

#include "radiosity/solvers/solver_settings.h"
#include "radiosity/transport/translucency.h"

namespace meninas {

/// Throws UsageError when the method is not for systems of that size.
void check_size(SolverMethod method, std::size_t unknowns);

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const std::vector<Rgb>& reflectance, const SolverSettings& settings = {},
                   const ShotPlan& plan = {});

/// The scattering of received light by rows: they reflect it, and translucent surfaces pass it on.
struct Scattering {
  const std::vector<Rgb>& reflectance;
  const TranslucentLinks& translucent;
};

/// With translucent surfaces: X = S + rho T X + tau (T X) behind (transport/translucency.h).
SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const Scattering& scattering, const SolverSettings& settings = {},
                   const ShotPlan& plan = {});

/// T x for every row, by band.
std::vector<Rgb> apply_transport(const Transport& transport, const std::vector<Rgb>& x);

} // namespace meninas
