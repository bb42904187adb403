// Solves the radiosity system  B = S + rho T B  (Eq. 1 with the direct light in the source S), knowing no geometry.
//
// Input: source in W/m^2, reflectance dimensionless, transport rows T >= 0. Output: B in W/m^2, by ElementId.
// Error bound: with the residual r_k = S + rho T B_k - B_k and T >= 0,
//   ||B - B_k|| <= G ||r_k||,   G = ||(1 - rho T)^-1|| <= (sum_{j<m} ||(rho T)^j 1||) / (1 - ||(rho T)^m 1||)
// in the maximum norm, per channel; m is raised until the bound is sharp. Iteration stops when G ||r_k|| <= tolerance ||B_k||.
// No such m (reflectance 1 in a closed room, say) means no bound: the result says converged = false.
// Deterministic for any thread count.
#pragma once

#include "radiosity/form_factors.h"

#include <vector>

namespace meninas {

enum class SolverMethod { gauss_seidel };

struct SolverSettings {
  SolverMethod method = SolverMethod::gauss_seidel;
  double tolerance = 1e-4;     ///< on ||B - B_k|| / ||B||, maximum norm, worst channel
  int max_iterations = 10'000; ///< a safety net; reaching it is reported as converged = false
};

struct SolverResult {
  std::vector<Rgb> radiosity;
  int iterations = 0;
  double residual = 0.0;    ///< ||r|| / ||B|| at the end, worst channel
  double error_bound = 0.0; ///< G ||r|| / ||B||, worst channel; infinite when there is no bound
  bool converged = false;
  std::vector<double> residuals; ///< after every check, first one first
};

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const std::vector<Rgb>& reflectance, const SolverSettings& settings = {});

/// T x for every row, by band.
std::vector<Rgb> apply_transport(const Transport& transport, const std::vector<Rgb>& x);

} // namespace meninas
