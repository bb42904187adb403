#include "radiosity/solvers/report.h"

namespace meninas {

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

template SolverEnd end_of(const Convergence<Rgb>&);
template SolverEnd end_of(const Convergence<double>&);
template SolverResult report_of(const SolverSettings&, const Convergence<Rgb>&, SolverEnd);
template SolverResult report_of(const SolverSettings&, const Convergence<double>&, SolverEnd);

} // namespace meninas
