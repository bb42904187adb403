#include "radiosity/radiosity_equation.h"

#include "radiosity/field/interpolation.h"
#include "radiosity/hierarchical/node_solution.h"
#include "radiosity/solvers/progressive.h"
#include "radiosity/solvers/shooting_blocks.h"
#include "radiosity/solvers/solve_together.h"
#include "radiosity/transport/gathered_emission.h"
#include "scenes/photometry.h"
#include "scenes/stopwatch.h"

namespace meninas {

namespace {

/// The data from which a watch is shown states, and the seconds that takes.
struct Watched {
  const LightScene& light;
  const PassOneSettings& settings;
  const FirstLight& first;
  const std::vector<RowClosure>& closure;
  const std::vector<float>& exposed;
  double seconds = 0.0;
};

/// The area of every element on which nothing stands, m^2.
std::vector<double> exposed_areas(const ElementMesh& mesh, const std::vector<float>& exposed) {
  std::vector<double> area = mesh.area;
  for (std::size_t i = 0; i < area.size(); ++i)
    area[i] *= double{exposed[i]};
  return area;
}

/// Shows the watch the field there is so far: H = D + G + what has been shot.
ShotWatch shown(Watched& watched, const PassOneWatch& watch) {
  std::vector<double> area = exposed_areas(watched.light.mesh, watched.exposed);
  const auto power_of = [&](const std::vector<Rgb>& light, const std::vector<double>& areas) {
    double power = 0.0;
    for (std::size_t i = 0; i < areas.size(); ++i)
      power += areas[i] * luminance_of(light[i]);
    return power;
  };
  const double first_power = power_of(watched.first.source, area);
  const auto look = [=, &watched, area = std::move(area)](const ShotsSoFar& shots) {
    const auto& [light, settings, first, closure, exposed, seconds] = watched;
    Stopwatch stopwatch;
    std::vector<Rgb> irradiance = shots.arrived;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
      irradiance[i] += first.irradiance[i];
    const auto interpolated =
        interpolate(light, {{}, std::move(irradiance), first.direct}, settings.form_factors,
                    settings.direct, {Interpolation::average});
    watch.look({shots.shots, interpolated.field,
                ambient_irradiance(area, closure, shots.unshot,
                                   total_shares(first.reflectance, first.translucent)),
                first_power > 0.0 ? power_of(shots.unshot, area) / first_power : 0.0});
    watched.seconds += stopwatch.lap();
  };
  return {watch.every, look};
}

} // namespace

ReflectedLight reflected_by_rows(const LightScene& light, const FormFactors& factors,
                                 const PassOneSettings& settings, const Progress& progress,
                                 const PassOneWatch& watch) {
  Stopwatch stopwatch;
  ReflectedLight solved;
  solved.closure = factors.closure;
  solved.exposed = factors.exposed;
  solved.rays_traced = factors.rays_traced;

  // Split by who owns the path: direct light, gathered emission, and reflected light by the transport.
  solved.first = first_light(
      light, {gathered_emission(light, factors), factors.closure, factors.covered, factors.exposed,
       gathered_by_lamp(light, factors)},
      settings.form_factors.method, settings.direct, progress);
  solved.form_factor_seconds = stopwatch.lap();

  Watched watched{light, settings, solved.first, factors.closure, factors.exposed};
  ShotPlan plan;
  if (settings.solver.method == SolverMethod::progressive)
    plan = {make_shooting_blocks(light.mesh, factors.exposed), shown(watched, watch)};
  else if (settings.solver.method == SolverMethod::jacobi && watch.every > 0)
    plan.watch = shown(watched, watch);
  const std::vector<double> areas = exposed_areas(light.mesh, factors.exposed);
  plan.areas = areas;
  if (watch.before_shots && plan.watch.look)
    plan.watch.look({0, std::vector<Rgb>(solved.first.source.size(), Rgb(0.0)), solved.first.source});
  solved.solver =
      solve(factors.transport, solved.first.source,
            {solved.first.reflectance, solved.first.translucent}, settings.solver, plan);
  solved.arrived = apply_transport(factors.transport, solved.solver.radiosity);
  if (light.lamps) {
    const Scattering scattering{solved.first.reflectance, solved.first.translucent};
    solved.by_lamp = solve_together(
        factors.transport, scattered(scattering, solved.first.by_lamp), scattering, settings.solver);
    solved.irradiance_by_lamp = solved.first.by_lamp;
    solved.irradiance_by_lamp += transport_product(factors.transport, solved.by_lamp);
  }
  solved.solve_seconds = stopwatch.lap() - watched.seconds;
  return solved;
}

ReflectedLight reflected_by_shots(const LightScene& light, const PassOneSettings& settings,
                                  const Progress& progress, const PassOneWatch& watch) {
  Stopwatch stopwatch;
  ReflectedLight solved;
  const HemisphereSurvey survey = survey_hemispheres(light, settings.form_factors, progress);
  solved.first =
      first_light(light, {survey.gathered, survey.closure, survey.covered, survey.exposed},
                  settings.form_factors.method, settings.direct, progress);
  solved.form_factor_seconds = stopwatch.lap();

  Watched watched{light, settings, solved.first, survey.closure, survey.exposed};
  const ShotWatch told = shown(watched, watch);
  if (watch.before_shots)
    told.look({0, std::vector<Rgb>(solved.first.source.size(), Rgb(0.0)), solved.first.source});
  ShotSolution shots = solve_by_shots(
      light, survey, {solved.first.source, {solved.first.reflectance, solved.first.translucent}},
      {settings.form_factors, settings.solver}, progress, told);
  solved.solver = std::move(shots.solver);
  solved.arrived = std::move(shots.arrived);
  solved.closure = survey.closure;
  solved.exposed = survey.exposed;
  solved.rays_traced = survey.rays_traced + shots.rays_traced;
  solved.solve_seconds = stopwatch.lap() - watched.seconds;
  return solved;
}

ReflectedLight reflected_by_nodes(const LightScene& light, const PassOneSettings& settings,
                                  const Progress& progress, std::span<const std::uint8_t> seen) {
  const bool vertices_gather = gathers_by_nodes(settings);
  Stopwatch watch;
  std::optional<LitVertices> vertices;
  if (vertices_gather)
    vertices = lit_vertices(
        light, {settings.form_factors, settings.direct, settings.interpolation, progress, seen});
  const double lighting = watch.lap();
  NodeSolution nodes = solve_by_nodes(
      light, {settings.form_factors, settings.direct, settings.hierarchical, settings.solver},
      std::move(vertices), progress);
  ReflectedLight solved;
  solved.first = std::move(nodes.first);
  solved.solver = std::move(nodes.solver);
  solved.arrived = std::move(nodes.arrived);
  solved.by_lamp = std::move(nodes.reflected_by_lamp);
  solved.irradiance_by_lamp = std::move(nodes.irradiance_by_lamp);
  solved.closure = std::move(nodes.closure);
  solved.exposed = std::move(nodes.exposed);
  solved.links = nodes.figures;
  solved.rays_traced = nodes.rays_traced;
  solved.form_factor_seconds = lighting + nodes.seconds_gathering;
  solved.solve_seconds = nodes.seconds_solving;
  if (vertices_gather)
    solved.receivers = std::move(nodes.receivers);
  return solved;
}

ReflectedLight reflected_light(const LightScene& light, const PassOneSettings& settings,
                               const Progress& progress, const PassOneWatch& watch,
                               std::span<const std::uint8_t> seen) {
  if (shoots_rays(settings, element_count(light.mesh)))
    return reflected_by_shots(light, settings, progress, watch);
  if (settings.cut == MeshCut::hierarchical)
    return reflected_by_nodes(light, settings, progress, seen);
  Stopwatch stopwatch;
  const FormFactors factors = assemble_transport(light, settings.form_factors, progress);
  const double seconds = stopwatch.lap();
  ReflectedLight solved = reflected_by_rows(light, factors, settings, progress, watch);
  solved.form_factor_seconds += seconds;
  return solved;
}

} // namespace meninas
