#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/report.h"
#include "radiosity/solvers/solvers.h"

#include <algorithm>

namespace meninas {

/// Rows of a step are computed from the same values, steps follow one another:
/// Gauss-Seidel between steps, so that the result does not depend on how many threads share a step.
static std::size_t rows_per_step(Relaxation order, std::size_t rows) {
  constexpr std::size_t gauss_seidel_steps = 32, least = 64;
  return order == Relaxation::jacobi
             ? std::max<std::size_t>(1, rows)
             : std::max(least, (rows + gauss_seidel_steps - 1) / gauss_seidel_steps);
}

/// After a sweep that began with x_{k-1} = `before`.
template <typename Value>
static void tell(const ShotWatch& watch, int sweep, const LinearSystem<Value>& system,
                 const std::vector<Value>& before, const std::vector<Value>& x) {
  std::vector<Value> unshot = x;
  for (std::size_t i = 0; i < x.size(); ++i)
    unshot[i] -= before[i];
  watch.look({sweep, colours_of(transport_product(system.transport, before)), colours_of(unshot)});
}

template <typename Value>
void relax(const LinearSystem<Value>& system, Relaxation order, std::vector<Value>& x,
           Convergence<Value>& convergence, const ShotWatch& watch) {
  std::vector<Value> before;
  const std::size_t step = rows_per_step(order, x.size());
  const Value kept = contraction(system);
  std::vector<Value> scratch(x.size());
  record(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
  while (!finished(convergence)) {
    if (watch.every > 0)
      before = x;
    Value change(0.0);
    for (std::size_t begin = 0; begin < x.size(); begin += step)
      change =
          glm::max(change, relax_rows(system, begin, std::min(x.size(), begin + step), x, scratch));
    ++convergence.iterations;
    const Value size = maximum_norm(x);
    record(convergence, kept * change, size);

    // Iterates that may be the last are measured by their residual.
    if (finished(convergence))
      record_again(convergence, maximum_norm(residual_of(system, x)), size);
    if (watch.every > 0 && (finished(convergence) || convergence.iterations % watch.every == 0))
      tell(watch, convergence.iterations, system, before, x);
  }
}

template void relax(const LinearSystem<Rgb>&, Relaxation, std::vector<Rgb>&, Convergence<Rgb>&,
                    const ShotWatch&);
template void relax(const LinearSystem<double>&, Relaxation, std::vector<double>&,
                    Convergence<double>&, const ShotWatch&);

} // namespace meninas
