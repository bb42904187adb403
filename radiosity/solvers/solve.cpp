#include "radiosity/solvers/solve.h"

#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/report.h"
#include "radiosity/solvers/solvers.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace meninas {

namespace {

template <typename Value>
void run(SolverMethod method, const LinearSystem<Value>& system, const ShotPlan& plan,
         std::vector<Value>& x, Convergence<Value>& convergence) {
  switch (method) {
  case SolverMethod::direct:
    return factorise_and_solve(system, x, convergence);
  case SolverMethod::jacobi:
    return relax(system, Relaxation::jacobi, x, convergence, plan.watch);
  case SolverMethod::gauss_seidel:
    return relax(system, Relaxation::gauss_seidel, x, convergence);
  case SolverMethod::bicgstab:
    return bicgstab(system, x, convergence);
  case SolverMethod::progressive:
    return shoot_stored(system, plan, x, convergence);
  }
}

/// B - S >= 0 in the solution: what is below S can only come nearer when it is raised to it.
template <typename Value>
void raise_to_source(const std::vector<Value>& source, std::vector<Value>& x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = glm::max(x[i], source[i]);
}

/// Rows that have light in a trap, in any channel; and whether any has light outside.
template <typename Value>
std::pair<std::vector<std::uint32_t>, bool> lit_in_traps(const std::vector<Value>& source,
                                                         const std::vector<Value>& open) {
  std::vector<std::uint32_t> trapped;
  bool outside = false;
  for (std::uint32_t i = 0; i < source.size(); ++i) {
    if (worst(source[i] * (Value(1.0) - open[i])) > 0.0)
      trapped.push_back(i);
    outside = outside || worst(source[i] * open[i]) > 0.0;
  }
  return {std::move(trapped), outside};
}

/// The bound is relative to the brightest spot. Where a lamp is shut in a lantern, that says nothing of the room:
/// the solver goes on until the error is small in the mean over area as well. Returns that error, if areas are known.
/// Two stop at the bound alone: shots would begin anew, and those who watch sweeps count them.
template <typename Value>
double run_until_all_is_near(SolverMethod method, const LinearSystem<Value>& system, const ShotPlan& plan,
                             std::vector<Value>& x, Convergence<Value>& convergence) {
  constexpr double tolerances = 10.0; // of the mean, as spots of ordinary rooms are ten times as bright as these
  constexpr double tighter = 0.1;
  const double asked = convergence.tolerance;
  run(method, system, plan, x, convergence);
  if (plan.areas.empty())
    return std::numeric_limits<double>::infinity();
  double off = worst(relative_error(system, x, plan.areas));
  const bool goes_on = method != SolverMethod::progressive && !plan.watch.look;
  while (goes_on && off > tolerances * asked && converged(convergence)) {
    convergence.tolerance *= tighter;
    convergence.residuals.pop_back(); // of the iterate that is recorded again as the first one
    convergence.error_bounds.pop_back();
    run(method, system, plan, x, convergence);
    off = worst(relative_error(system, x, plan.areas));
  }
  convergence.tolerance = asked;
  return off;
}

template <typename Value>
SolverResult solve_system(const LinearSystem<Value>& whole, const SolverSettings& settings,
                          const ShotPlan& plan) {
  const std::vector<Value> open = open_rows(whole);
  auto [trapped, outside] = lit_in_traps(whole.source, open);
  const bool unsolvable = !trapped.empty() && !outside;
  const LinearSystem<Value> system = without_traps(whole, open);
  const Value unbounded(std::numeric_limits<double>::infinity());
  const bool by_shots = settings.method == SolverMethod::progressive;
  const std::size_t shooters =
      plan.shooters.begin.empty() ? system.transport.size : plan.shooters.size();
  std::vector<Value> x = system.source;
  auto convergence =
      stopping_rule(settings,
                    unsolvable ? unbounded
                               : amplification_bound(system, settings.max_iterations),
                    by_shots ? std::max<std::size_t>(1, shooters) : 1);
  convergence.progress = plan.progress;
  double off = std::numeric_limits<double>::infinity();
  SolverEnd end = SolverEnd::unsolvable;
  if (unsolvable) {
    record(convergence, maximum_norm(residual_of(whole, x)), maximum_norm(x));
  } else {
    off = run_until_all_is_near(settings.method, system, plan, x, convergence);
    raise_to_source(system.source, x);
    end = end_of(convergence);
  }
  SolverResult result = report_of(settings, convergence, end);
  result.relative_error = off;
  result.radiosity = colours_of(x);
  result.trapped = std::move(trapped);
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
  case SolverMethod::progressive:
    return "progressive";
  }
  return "";
}

void check_size(SolverMethod method, std::size_t unknowns) {
  if (method == SolverMethod::direct && unknowns > max_direct_unknowns)
    throw UsageError("--solver direct", fmt::format("solves for at most {} elements, here are {}",
                                                    max_direct_unknowns, unknowns));
}

std::vector<Rgb> apply_transport(const Transport& transport, const std::vector<Rgb>& x) {
  expects(x.size() == transport.size, "the transport applies to one value per element");
  return transport_product(transport, x);
}

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const std::vector<Rgb>& reflectance, const SolverSettings& settings,
                   const ShotPlan& plan) {
  expects(source.size() == transport.size && reflectance.size() == transport.size,
          "source and reflectance have one value per element");
  check_size(settings.method, transport.size);
  const bool grey = transport.bands == 1 && std::ranges::all_of(source, is_grey_colour) &&
                    std::ranges::all_of(reflectance, is_grey_colour);
  if (grey)
    return solve_system<double>(
        {transport, values_of<double>(source), values_of<double>(reflectance)}, settings, plan);
  return solve_system<Rgb>({transport, source, reflectance}, settings, plan);
}

/// The irradiance by rows that are not mixed: H = T (B - U) of B = S + total H' so far.
static ShotsSoFar unmixed(const Transport& transport, const std::vector<Rgb>& source,
                          const std::vector<Rgb>& total, ShotsSoFar shots) {
  for (std::size_t i = 0; i < source.size(); ++i)
    shots.arrived[i] = source[i] + total[i] * shots.arrived[i] - shots.unshot[i];
  shots.arrived = apply_transport(transport, shots.arrived);
  return shots;
}

SolverResult solve(const Transport& transport, const std::vector<Rgb>& source,
                   const Scattering& scattering, const SolverSettings& settings,
                   const ShotPlan& plan) {
  if (scattering.translucent.empty())
    return solve(transport, source, scattering.reflectance, settings, plan);
  const MixedRows mixed = mixed_rows(transport, scattering.reflectance, scattering.translucent);
  ShotPlan shown = plan;
  if (plan.watch.look)
    shown.watch.look = [&](const ShotsSoFar& shots) {
      plan.watch.look(unmixed(transport, source, mixed.total, shots));
    };
  return solve(mixed.transport, source, mixed.total, settings, shown);
}

} // namespace meninas
