// The stopping rule of the solvers: residuals, and the bound on the error that follows from them,
//
//   ||B - B_k|| <= G ||r_k|| <= tolerance ||B_k||,     G of error_bound.h
#pragma once

#include "radiosity/solvers/solver_settings.h"
#include "radiosity/transport/linear_system.h"
#include "scenes/progress.h"

namespace meninas {

/// The iterates of a solver, as far as the stopping rule is concerned.
template <typename Value>
struct Convergence {
  Value amplification; ///< G
  double tolerance = 0.0;
  int max_iterations = 0;
  int iterations = 0;
  std::vector<Value> residuals, error_bounds; ///< ||r_k|| / ||B_k|| and G times that
  Progress progress = {}; ///< told of every iterate
};

/// The rule for a solver whose iterations are sweeps (`shooters` 1), or shots of so many shooters in place of one
/// sweep. `amplification`: G. Without a bound, G infinite, a hundred bounces show what light there is.
template <typename Value>
Convergence<Value> stopping_rule(const SolverSettings& settings, const Value& amplification,
                                 std::size_t shooters);

template <typename Value>
void record(Convergence<Value>& convergence, const Value& residual_norm, const Value& size);

/// The last iterate once more, measured.
template <typename Value>
void record_again(Convergence<Value>& convergence, const Value& residual_norm, const Value& size);

/// No channel may be further from the solution than asked.
template <typename Value>
bool converged(const Convergence<Value>& convergence);

/// The residual is that of rounding;
/// or, where no bound tells what a smaller one would be good for, it is within the tolerance.
template <typename Value>
bool exhausted(const Convergence<Value>& convergence);

template <typename Value>
bool finished(const Convergence<Value>& convergence) {
  return converged(convergence) || exhausted(convergence) ||
         convergence.iterations >= convergence.max_iterations;
}

/// 1 for every channel that is further from the solution than asked,
/// or 0 for all when there is nothing more to do.
template <typename Value>
Value unfinished_channels(const Convergence<Value>& convergence);

} // namespace meninas
