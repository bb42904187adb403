#include "radiosity/solvers/progressive.h"

#include "radiosity/solvers/ray_shots.h"
#include "radiosity/solvers/shooting_blocks.h"
#include "radiosity/solvers/shot_bound.h"
#include "radiosity/solvers/report.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The scene in which light is shot.
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

/// The fraction of a run that is done: residuals fall geometrically.
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

/// The callbacks that are told of shots.
struct ShotEvents {
  const Progress& progress;
  const ShotWatch& watch;
};

/// Traps reflect nothing, nor do they pass anything on: both sides of a surface are of one part.
void leave_out_traps(const std::vector<Rgb>& open, std::vector<Rgb>& reflectance,
                     TranslucentLinks& links) {
  for (std::size_t e = 0; e < open.size(); ++e)
    reflectance[e] *= open[e];
  for (std::size_t e = 0; e < open.size() && !links.empty(); ++e)
    for (auto k = links.row_begin[e]; k < links.row_begin[e + 1]; ++k)
      links.transmittance[k] *= open[e];
}

/// S, rho and tau.
template <typename Value>
struct ShotProblem {
  const std::vector<Value>& source;
  const std::vector<Value>& reflectance;
  const PassedShots& translucent;
};

template <typename Value>
ShotSolution run(const ShotScene& scene, const ShotProblem<Value>& problem, const ShotBound& bound,
                 const SolverSettings& settings, const ShotEvents& events) {
  ShotState<Value> state =
      unshot_state(scene.blocks, problem.source, problem.reflectance, ShotNorm::power);
  if (!problem.translucent.from.empty())
    state.translucent = &problem.translucent;
  auto convergence = stopping_rule(settings, value_of<Value>(bound.amplification),
                                   std::max<std::size_t>(1, scene.blocks.size()));
  if (bound.unsolvable)
    convergence.max_iterations = 0;
  RayShots<Value> shots(scene.light, scene.survey, scene.rays);
  const auto tell = observer_of<Value>(events.watch);
  shoot<Value>(shots, value_of<Value>(bound.kept), state, convergence,
               [&](const ShotState<Value>& now, const Convergence<Value>& reached) {
                 tell(now, reached);
                 if (events.progress)
                   events.progress("shots", fraction_done(reached));
               });
  ShotSolution solution;
  solution.solver =
      report_of(settings, convergence, bound.unsolvable ? SolverEnd::unsolvable : end_of(convergence));
  solution.solver.trapped = bound.trapped;
  solution.solver.radiosity = colours_of(radiosities(state));
  solution.arrived = colours_of(state.arrived);
  solution.rays_traced = bound.rays_traced + shots.rays_traced();
  return solution;
}

} // namespace

Rgb ambient_irradiance(const std::vector<double>& area, const std::vector<RowClosure>& closure,
                       const std::vector<Rgb>& unshot, const std::vector<Rgb>& reflectance) {
  double whole = 0.0;
  Rgb landing(0.0), returned(0.0);
  for (std::size_t j = 0; j < area.size(); ++j) {
    const Rgb landed = area[j] * landed_share(closure[j]);
    whole += area[j];
    landing += landed * unshot[j];
    returned += landed * reflectance[j];
  }
  Rgb ambient(0.0);
  for (int band = 0; band < 3; ++band)
    if (whole > returned[band]) // nothing else would ever end
      ambient[band] = landing[band] / (whole - returned[band]);
  return ambient;
}

ShotSolution solve_by_shots(const LightScene& light, const HemisphereSurvey& survey,
                            const ShotSource& from, const ShotSettings& settings,
                            const Progress& progress, const ShotWatch& watch) {
  const auto& [source, scattering] = from;
  const ShotBound bound = bound_of_shots(light, survey, settings.rays, source, scattering);
  std::vector<Rgb> reflectance = scattering.reflectance;
  TranslucentLinks links = scattering.translucent;
  leave_out_traps(bound.open, reflectance, links);
  const PassedShots translucent{links, transposed(links)};
  const auto& [rays, solver] = settings;
  const ShotScene scene{light, survey, rays, make_shooting_blocks(light.mesh, survey.exposed)};
  const bool grey = grey_mirrors(light.scene) && std::ranges::all_of(source, is_grey_colour) &&
                    std::ranges::all_of(reflectance, is_grey_colour) &&
                    std::ranges::all_of(links.transmittance, is_grey_colour);
  if (grey)
    return run<double>(scene,
                       {values_of<double>(source), values_of<double>(reflectance), translucent},
                       bound, solver, {progress, watch});
  return run<Rgb>(scene, {source, reflectance, translucent}, bound, solver, {progress, watch});
}

} // namespace meninas
