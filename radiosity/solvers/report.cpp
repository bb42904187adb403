#include "radiosity/solvers/report.h"

#include <algorithm>
#include <limits>

namespace meninas {

/// This many bounces show what light there is where nothing can be said of the rest.
static constexpr int unbounded_iterations = 100;

static int times(int iterations, std::size_t shooters) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  return static_cast<int>(std::min(most, static_cast<std::size_t>(iterations) * shooters));
}

template <typename Value>
Convergence<Value> stopping_rule(const SolverSettings& settings, const Value& amplification,
                                 std::size_t shooters) {
  const bool bounded = worst(amplification) < std::numeric_limits<double>::infinity();
  const int sweeps =
      bounded ? settings.max_iterations : std::min(settings.max_iterations, unbounded_iterations);
  Convergence<Value> convergence;
  convergence.amplification = amplification;
  convergence.tolerance = settings.tolerance;
  convergence.max_iterations = times(sweeps, shooters);
  if (settings.method == SolverMethod::progressive && settings.max_shots)
    convergence.max_iterations = *settings.max_shots;
  return convergence;
}

template <typename Value>
SolverEnd end_of(const Convergence<Value>& convergence) {
  if (converged(convergence))
    return SolverEnd::converged;
  return convergence.iterations >= convergence.max_iterations ? SolverEnd::iteration_limit
                                                              : SolverEnd::rounding;
}

template <typename Value>
SolverResult report_of(const SolverSettings& settings, const Convergence<Value>& convergence,
                       SolverEnd end) {
  SolverResult result;
  result.method = settings.method;
  result.bands = channel_count<Value>;
  result.iterations = convergence.iterations;
  result.end = end;
  result.converged = end == SolverEnd::converged;
  result.channel_residuals = colours_of(convergence.residuals);
  result.channel_error_bounds = colours_of(convergence.error_bounds);
  for (const auto& residual : convergence.residuals)
    result.residuals.push_back(worst(residual));
  result.residual = result.residuals.back();
  result.error_bound = worst(convergence.error_bounds.back());
  return result;
}

template Convergence<Rgb> stopping_rule(const SolverSettings&, const Rgb&, std::size_t);
template Convergence<double> stopping_rule(const SolverSettings&, const double&, std::size_t);
template SolverEnd end_of(const Convergence<Rgb>&);
template SolverEnd end_of(const Convergence<double>&);
template SolverResult report_of(const SolverSettings&, const Convergence<Rgb>&, SolverEnd);
template SolverResult report_of(const SolverSettings&, const Convergence<double>&, SolverEnd);

} // namespace meninas
