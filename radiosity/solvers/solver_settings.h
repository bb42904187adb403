// Settings and result of a solver of B = S + rho T B (solve.h): the method, the stopping rule, and the
// residual r_k = S + rho T B_k - B_k with the bound of the error at the end.
#pragma once

#include "radiosity/solvers/shooters.h"
#include "radiosity/transport/form_factor_rows.h"
#include "scenes/progress.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace meninas {

enum class SolverMethod { direct, jacobi, gauss_seidel, bicgstab, progressive };
inline constexpr std::array solver_methods{SolverMethod::direct, SolverMethod::jacobi,
                                           SolverMethod::gauss_seidel, SolverMethod::bicgstab,
                                           SolverMethod::progressive};
/// As users call it.
const char* name_of(SolverMethod method);

struct SolverSettings {
  SolverMethod method = SolverMethod::bicgstab;
  double tolerance = 1e-4; ///< on ||B - B_k|| / ||B_k||, maximum norm, every channel
  int max_iterations =
      10'000; ///< a safety net; reaching it is reported. Of `progressive`: by shooter
  std::optional<int> max_shots = {}; ///< of `progressive`, whose iterations are shots
};

/// The shooters of `progressive`, its watch, and what a result is to tell.
struct ShotPlan {
  Shooters shooters; ///< none: every unknown for itself
  ShotWatch watch;
  Progress progress = {}; ///< told after every iterate, of any method; what it throws ends the solve
  std::span<const double> areas = {}; ///< of the unknowns, m^2, for the error of the result in the mean; none: it is not found
};

/// Why a solver stopped.
enum class SolverEnd {
  converged,
  iteration_limit,
  rounding, ///< the residual is as small as rounding lets it be (without a bound: as the tolerance), the bound is not
  unsolvable ///< all light is in closed parts of the scene that absorb nothing: it would grow without end
};

struct SolverResult {
  SolverMethod method = SolverMethod::bicgstab;
  std::vector<Rgb> radiosity;
  int iterations = 0;
  int bands = 3;            ///< solved for: one when everything is grey
  double residual = 0.0;    ///< ||r|| / ||B|| at the end, worst channel
  double error_bound = 0.0; ///< G ||r|| / ||B||, worst channel; infinite when there is no bound
  /// The mean over the area of all unknowns of |B - B_k| / B_k, an estimate, worst channel; infinite where it is not known.
  double relative_error = std::numeric_limits<double>::infinity();
  bool converged = false;
  SolverEnd end = SolverEnd::converged;
  /// Unknowns, or the elements below, with light that nothing absorbs and that cannot leave: they reflect none.
  std::vector<std::uint32_t> trapped;
  std::vector<double>
      residuals; ///< of every iterate, first one first, worst channel; of many shots every second, fourth, ...
  std::vector<Rgb> channel_residuals, channel_error_bounds; ///< the same for every channel
};

/// LU factors of that many unknowns take 128 MiB and some ten seconds a band.
inline constexpr std::size_t max_direct_unknowns = 4096;

} // namespace meninas
