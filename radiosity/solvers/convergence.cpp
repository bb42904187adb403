#include "radiosity/solvers/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

/// This many bounces show what light there is where no bound is known.
static constexpr int unbounded_iterations = 100;

static int iterations_of(int sweeps, std::size_t shooters) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  return static_cast<int>(std::min(most, static_cast<std::size_t>(sweeps) * shooters));
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
  convergence.max_iterations = iterations_of(sweeps, shooters);
  if (settings.method == SolverMethod::progressive && settings.max_shots)
    convergence.max_iterations = *settings.max_shots;
  return convergence;
}

/// The fraction done of the orders of magnitude by which the error has to fall: 0 to 1.
template <typename Value>
static double share_done(const Convergence<Value>& convergence) {
  const double first = worst(convergence.error_bounds.front()),
               now = worst(convergence.error_bounds.back());
  if (!(now > convergence.tolerance))
    return 1.0;
  const double share = std::log(first / now) / std::log(first / convergence.tolerance);
  return share > 0.0 ? std::min(share, 1.0) : 0.0;
}

template <typename Value>
void record(Convergence<Value>& convergence, const Value& residual_norm, const Value& size) {
  // A residual computed from values of that size is itself not known better than their rounding.
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  Value bound(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    if (channel(size, band) > 0.0)
      channel(bound, band) = channel(convergence.amplification, band) *
                             (channel(residual_norm, band) / channel(size, band) + rounding);
  convergence.residuals.push_back(share_of(residual_norm, size));
  convergence.error_bounds.push_back(bound);
  if (convergence.progress)
    convergence.progress("solve", share_done(convergence));
}

template <typename Value>
void record_again(Convergence<Value>& convergence, const Value& residual_norm, const Value& size) {
  convergence.residuals.pop_back();
  convergence.error_bounds.pop_back();
  record(convergence, residual_norm, size);
}

template <typename Value>
Value unfinished_channels(const Convergence<Value>& convergence) {
  Value unfinished(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    channel(unfinished, band) = !finished(convergence) && channel(convergence.error_bounds.back(),
                                                                  band) > convergence.tolerance
                                    ? 1.0
                                    : 0.0;
  return unfinished;
}

template <typename Value>
bool converged(const Convergence<Value>& convergence) {
  return worst(convergence.error_bounds.back()) <= convergence.tolerance;
}

template <typename Value>
bool exhausted(const Convergence<Value>& convergence) {
  const bool bounded = worst(convergence.amplification) < std::numeric_limits<double>::infinity();
  const double least =
      bounded ? 4.0 * std::numeric_limits<double>::epsilon() : convergence.tolerance;
  return worst(convergence.residuals.back()) <= least;
}

template Convergence<Rgb> stopping_rule(const SolverSettings&, const Rgb&, std::size_t);
template Convergence<double> stopping_rule(const SolverSettings&, const double&, std::size_t);
template void record(Convergence<Rgb>&, const Rgb&, const Rgb&);
template void record(Convergence<double>&, const double&, const double&);
template void record_again(Convergence<Rgb>&, const Rgb&, const Rgb&);
template void record_again(Convergence<double>&, const double&, const double&);
template Rgb unfinished_channels(const Convergence<Rgb>&);
template double unfinished_channels(const Convergence<double>&);
template bool converged(const Convergence<Rgb>&);
template bool converged(const Convergence<double>&);
template bool exhausted(const Convergence<Rgb>&);
template bool exhausted(const Convergence<double>&);

} // namespace meninas
