#include "radiosity/solvers/error_bound.h"
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

template <typename Value>
void relax(const LinearSystem<Value>& system, Relaxation order, std::vector<Value>& x,
           Convergence<Value>& convergence) {
  const std::size_t step = rows_per_step(order, x.size());
  const Value kept = contraction(system);
  std::vector<Value> scratch(x.size());
  record(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
  while (!finished(convergence)) {
    Value change(0.0);
    for (std::size_t begin = 0; begin < x.size(); begin += step)
      change =
          glm::max(change, relax_rows(system, begin, std::min(x.size(), begin + step), x, scratch));
    ++convergence.iterations;
    const Value size = maximum_norm(x);
    record(convergence, kept * change, size);

    // What may be the last word is measured.
    if (finished(convergence))
      record_again(convergence, maximum_norm(residual_of(system, x)), size);
  }
}

template void relax(const LinearSystem<Rgb>&, Relaxation, std::vector<Rgb>&, Convergence<Rgb>&);
template void relax(const LinearSystem<double>&, Relaxation, std::vector<double>&,
                    Convergence<double>&);

} // namespace meninas
