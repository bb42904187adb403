#include "radiosity/solve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// Rows of a step are computed from the same values, steps follow one another: Gauss-Seidel between steps, so that the
/// result does not depend on how many threads share a step.
constexpr std::size_t gauss_seidel_steps = 32;

constexpr int unbounded_iterations = 100;

template <int bands>
Rgb row_product(const Transport& transport, std::size_t row, const std::vector<Rgb>& x) {
  Rgb sum(0.0);
  for (auto k = transport.row_begin[row]; k < transport.row_begin[row + 1]; ++k) {
    const Rgb& value = x[transport.columns[k]];
    if constexpr (bands == 1)
      sum += double{transport.weights[k]} * value;
    else
      sum += Rgb(transport.weights[3 * k], transport.weights[3 * k + 1],
                 transport.weights[3 * k + 2]) *
             value;
  }
  return sum;
}

Rgb row_product(const Transport& transport, std::size_t row, const std::vector<Rgb>& x) {
  return transport.bands == 1 ? row_product<1>(transport, row, x)
                              : row_product<3>(transport, row, x);
}

Rgb maximum_norm(const std::vector<Rgb>& x) {
  Rgb norm(0.0);
  for (const auto& value : x)
    norm = glm::max(norm, glm::abs(value));
  return norm;
}

/// S + rho T x - x
std::vector<Rgb> residual_of(const Transport& transport, const std::vector<Rgb>& source,
                             const std::vector<Rgb>& reflectance, const std::vector<Rgb>& x) {
  std::vector<Rgb> residual = apply_transport(transport, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    residual[i] = source[i] + reflectance[i] * residual[i] - x[i];
  return residual;
}

/// One pass over all rows, in place.
void sweep(const Transport& transport, const std::vector<Rgb>& source,
           const std::vector<Rgb>& reflectance, std::vector<Rgb>& x, std::vector<Rgb>& scratch) {
  const std::size_t step =
      std::max<std::size_t>(64, (x.size() + gauss_seidel_steps - 1) / gauss_seidel_steps);
  for (std::size_t begin = 0; begin < x.size(); begin += step) {
    const std::size_t end = std::min(x.size(), begin + step);
    tbb::parallel_for(begin, end, [&](std::size_t i) {
      scratch[i] = source[i] + reflectance[i] * row_product(transport, i, x);
    });
    std::copy(scratch.begin() + static_cast<std::ptrdiff_t>(begin),
              scratch.begin() + static_cast<std::ptrdiff_t>(end),
              x.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

/// Raises m in G <= (sum_{j<m} ||(rho T)^j 1||) / (1 - ||(rho T)^m 1||) until more would not sharpen it much.
Rgb amplification_bound(const Transport& transport, const std::vector<Rgb>& reflectance) {
  constexpr int most_powers = 64;
  constexpr double sharp = 0.5;
  std::vector<Rgb> power(transport.size, Rgb(1.0));
  Rgb sum(0.0), best(std::numeric_limits<double>::infinity());
  for (int m = 1; m <= most_powers; ++m) {
    sum += maximum_norm(power);
    power = apply_transport(transport, power);
    for (std::size_t i = 0; i < power.size(); ++i)
      power[i] *= reflectance[i];
    const Rgb norm = maximum_norm(power);

    // The weights are floats: m products of rows that add up to one may come out this much below it.
    const double rounding = 4.0 * m * std::numeric_limits<float>::epsilon();
    for (int band = 0; band < 3; ++band)
      if (norm[band] < 1.0 - rounding)
        best[band] = std::min(best[band], sum[band] / (1.0 - norm[band]));
    if (glm::all(glm::lessThan(norm, Rgb(sharp))))
      break;
  }
  return best;
}

/// Largest over the channels of bound * residual / size, where a dark channel has no error to speak of.
double relative(const Rgb& bound, const Rgb& residual, const Rgb& size) {
  double worst = 0.0;
  for (int band = 0; band < 3; ++band)
    if (residual[band] > 0.0)
      worst = std::max(worst, bound[band] * (residual[band] / size[band]));
  return worst;
}

} // namespace

std::vector<Rgb> apply_transport(const Transport& transport, const std::vector<Rgb>& x) {
  expects(x.size() == transport.size, "the transport applies to one value per element");
  std::vector<Rgb> product(x.size());
  tbb::parallel_for(std::size_t{0}, x.size(),
                    [&](std::size_t i) { product[i] = row_product(transport, i, x); });
  return product;
}

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const std::vector<Rgb>& reflectance, const SolverSettings& settings) {
  expects(source.size() == transport.size && reflectance.size() == transport.size,
          "source and reflectance have one value per element");
  const Rgb bound = amplification_bound(transport, reflectance);

  SolverResult result;
  result.radiosity = source;
  std::vector<Rgb> scratch(source.size());
  for (;;) {
    const Rgb size = maximum_norm(result.radiosity);
    const Rgb residual =
        maximum_norm(residual_of(transport, source, reflectance, result.radiosity));
    result.residual = relative(Rgb(1.0), residual, size);
    result.error_bound = relative(bound, residual, size);
    result.residuals.push_back(result.residual);
    result.converged = result.error_bound <= settings.tolerance;

    // Below the rounding of the values the residual cannot fall any further.
    const bool exhausted = result.residual <= 4.0 * std::numeric_limits<double>::epsilon();
    if (result.converged || exhausted || result.iterations >= settings.max_iterations)
      return result;

    // Without a bound there may be no solution: a few sweeps show the light spreading, more would only run for ever.
    if (!std::isfinite(result.error_bound) && result.iterations >= unbounded_iterations)
      return result;
    sweep(transport, source, reflectance, result.radiosity, scratch);
    ++result.iterations;
  }
}

} // namespace meninas
