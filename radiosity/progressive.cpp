#include "radiosity/progressive.h"

#include "radiosity/ray_shots.h"
#include "radiosity/shooting_blocks.h"
#include "radiosity/solvers/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

namespace {

/// What is shot, and to whom.
struct ShotScene {
  const LightScene& light;
  const HemisphereSurvey& survey;
  const FormFactorSettings& rays;
  Shooters blocks;
};

/// f: the share of an element's light that lands on elements.
Rgb landed_share(const RowClosure& row) {
  const Rgb lost = Rgb(row.escaped_light) + Rgb(row.black_light) + Rgb(row.mirror_absorbed);
  return glm::clamp(1.0 - lost / glm::max(Rgb(1e-9), 1.0 - Rgb(row.cut_light)), 0.0, 1.0);
}

template <typename Value>
Rgb ambient_irradiance(const ShotScene& scene, const ShotState<Value>& state) {
  double area = 0.0;
  Rgb landing(0.0), returned(0.0);
  for (std::size_t j = 0; j < state.unshot.size(); ++j) {
    const double own = scene.blocks.measure[j];
    const Rgb landed = own * landed_share(scene.survey.closure[j]);
    area += own;
    landing += landed * Rgb(state.unshot[j]);
    returned += landed * Rgb(state.reflectance[j]);
  }
  Rgb ambient(0.0);
  for (int band = 0; band < 3; ++band)
    if (area > returned[band]) // nothing else would ever end
      ambient[band] = landing[band] / (area - returned[band]);
  return ambient;
}

/// kappa, of the elements that ever have something to shoot: black ones only receive.
template <typename Value>
Value largest_return(const HemisphereSurvey& survey, const std::vector<Value>& reflectance) {
  Value largest(0.0);
  for (std::size_t j = 0; j < reflectance.size(); ++j)
    for (int band = 0; band < channel_count<Value>; ++band)
      if (channel(reflectance[j], band) > 0.0)
        channel(largest, band) = std::max(channel(largest, band),
                                          channel(value_of<Value>(survey.returned[j]), band));
  return largest;
}

/// G = 1 / (1 - kappa)
template <typename Value>
Value amplification(const Value& kappa) {
  Value bound(std::numeric_limits<double>::infinity());
  for (int band = 0; band < channel_count<Value>; ++band)
    if (channel(kappa, band) < 1.0)
      channel(bound, band) = 1.0 / (1.0 - channel(kappa, band));
  return bound;
}

/// How far a run is: residuals fall geometrically.
template <typename Value>
double fraction_done(const Convergence<Value>& convergence) {
  const double by_shots =
      convergence.iterations / static_cast<double>(std::max(1, convergence.max_iterations));
  const double first = worst(convergence.error_bounds.front()),
               now = worst(convergence.error_bounds.back());
  if (!(now > 0.0) || !(first > convergence.tolerance) || !std::isfinite(first))
    return by_shots;
  return std::max(by_shots, std::log(first / now) / std::log(first / convergence.tolerance));
}

template <typename Value>
ShotSolution run(const ShotScene& scene, const std::vector<Value>& source,
                 const std::vector<Value>& reflectance, const SolverSettings& settings,
                 const Progress& progress, const ShotWatch& watch) {
  ShotState<Value> state = unshot_state(scene.blocks, source, reflectance, ShotNorm::power);
  const Value kappa = largest_return(scene.survey, reflectance);
  auto convergence = stopping_rule(settings, amplification(kappa),
                                   std::max<std::size_t>(1, scene.blocks.size()));
  const bool trapped = has_lit_trap(scene.light.mesh, scene.survey, colours_of(source));
  if (trapped)
    convergence.max_iterations = 0;
  RayShots<Value> shots(scene.light, scene.survey, scene.rays);
  shoot<Value>(shots, kappa, state, convergence,
               [&](const ShotState<Value>& now, const Convergence<Value>& reached) {
                 if (watch.every > 0 && now.shots % watch.every == 0)
                   watch.look(
                       {now.shots, colours_of(now.arrived), ambient_irradiance(scene, now)});
                 if (progress)
                   progress("shots", fraction_done(reached));
               });
  ShotSolution solution;
  solution.solver =
      report_of(settings, convergence, trapped ? SolverEnd::unsolvable : end_of(convergence));
  solution.solver.radiosity = colours_of(radiosities(state));
  solution.arrived = colours_of(state.arrived);
  solution.rays_traced = shots.rays_traced();
  return solution;
}

} // namespace

ShotSolution solve_by_shots(const LightScene& light, const HemisphereSurvey& survey,
                            const std::vector<Rgb>& source, const std::vector<Rgb>& reflectance,
                            const FormFactorSettings& rays, const SolverSettings& settings,
                            const Progress& progress, const ShotWatch& watch) {
  const ShotScene scene{light, survey, rays, make_shooting_blocks(light.mesh, survey.exposed)};
  const bool grey = grey_mirrors(light.scene) && std::ranges::all_of(source, is_grey) &&
                    std::ranges::all_of(reflectance, is_grey);
  if (grey)
    return run<double>(scene, values_of<double>(source), values_of<double>(reflectance), settings,
                       progress, watch);
  return run<Rgb>(scene, source, reflectance, settings, progress, watch);
}

} // namespace meninas
