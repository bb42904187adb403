#include "radiosity/solve.h"

#include "radiosity/solvers/solvers.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace {

/// Without a bound of the error there is nothing to iterate for; this many bounces show what light there is.
constexpr int unbounded_iterations = 100;

bool is_grey(const Rgb& colour) { return colour.r == colour.g && colour.g == colour.b; }

template <typename Value>
Value value_of(const Rgb& colour) {
  if constexpr (channel_count<Value> == 1)
    return colour.r;
  else
    return colour;
}

template <typename Value>
std::vector<Value> values_of(const std::vector<Rgb>& colours) {
  std::vector<Value> values;
  values.reserve(colours.size());
  for (const auto& colour : colours)
    values.push_back(value_of<Value>(colour));
  return values;
}

template <typename Value>
std::vector<Rgb> colours_of(const std::vector<Value>& values) {
  std::vector<Rgb> colours;
  colours.reserve(values.size());
  for (const auto& value : values)
    colours.emplace_back(value);
  return colours;
}

template <typename Value>
void run(SolverMethod method, const LinearSystem<Value>& system, std::vector<Value>& x,
         Convergence<Value>& convergence) {
  switch (method) {
  case SolverMethod::direct:
    return factorise_and_solve(system, x, convergence);
  case SolverMethod::jacobi:
    return relax(system, Relaxation::jacobi, x, convergence);
  case SolverMethod::gauss_seidel:
    return relax(system, Relaxation::gauss_seidel, x, convergence);
  case SolverMethod::bicgstab:
    return bicgstab(system, x, convergence);
  }
}

template <typename Value>
SolverEnd end_of(const Convergence<Value>& convergence) {
  if (converged(convergence))
    return SolverEnd::converged;
  return convergence.iterations >= convergence.max_iterations ? SolverEnd::iteration_limit
                                                              : SolverEnd::rounding;
}

/// B - S >= 0 in the solution: what is below S can only come nearer when it is raised to it.
template <typename Value>
void raise_to_source(const std::vector<Value>& source, std::vector<Value>& x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = glm::max(x[i], source[i]);
}

template <typename Value>
SolverResult solve_system(const LinearSystem<Value>& system, const SolverSettings& settings) {
  SolverResult result;
  result.method = settings.method;
  result.bands = channel_count<Value>;
  std::vector<Value> x = system.source;
  Convergence<Value> convergence;
  convergence.tolerance = settings.tolerance;
  convergence.max_iterations = settings.max_iterations;
  if (has_lit_trap(system)) {
    convergence.amplification = Value(std::numeric_limits<double>::infinity());
    record(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
    result.end = SolverEnd::unsolvable;
  } else {
    convergence.amplification = amplification_bound(system);
    if (worst(convergence.amplification) == std::numeric_limits<double>::infinity())
      convergence.max_iterations = std::min(convergence.max_iterations, unbounded_iterations);
    run(settings.method, system, x, convergence);
    raise_to_source(system.source, x);
    result.end = end_of(convergence);
  }
  result.radiosity = colours_of(x);
  result.iterations = convergence.iterations;
  result.converged = result.end == SolverEnd::converged;
  result.channel_residuals = colours_of(convergence.residuals);
  result.channel_error_bounds = colours_of(convergence.error_bounds);
  for (const auto& residual : convergence.residuals)
    result.residuals.push_back(worst(residual));
  result.residual = result.residuals.back();
  result.error_bound = worst(convergence.error_bounds.back());
  return result;
}

} // namespace

const char* name_of(SolverMethod method) {
  switch (method) {
  case SolverMethod::direct:
    return "direct";
  case SolverMethod::jacobi:
    return "jacobi";
  case SolverMethod::gauss_seidel:
    return "gauss-seidel";
  case SolverMethod::bicgstab:
    return "cg";
  }
  return "";
}

void check_size(SolverMethod method, std::size_t unknowns) {
  if (method == SolverMethod::direct && unknowns > most_direct_unknowns)
    throw UsageError("--solver direct", fmt::format("solves for at most {} elements, here are {}",
                                                    most_direct_unknowns, unknowns));
}

std::vector<Rgb> apply_transport(const Transport& transport, const std::vector<Rgb>& x) {
  expects(x.size() == transport.size, "the transport applies to one value per element");
  return transport_product(transport, x);
}

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const std::vector<Rgb>& reflectance, const SolverSettings& settings) {
  expects(source.size() == transport.size && reflectance.size() == transport.size,
          "source and reflectance have one value per element");
  check_size(settings.method, transport.size);
  const bool grey = transport.bands == 1 && std::ranges::all_of(source, is_grey) &&
                    std::ranges::all_of(reflectance, is_grey);
  if (grey)
    return solve_system<double>(
        {transport, values_of<double>(source), values_of<double>(reflectance)}, settings);
  return solve_system<Rgb>({transport, source, reflectance}, settings);
}

} // namespace meninas
