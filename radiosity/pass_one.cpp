#include "radiosity/pass_one.h"

#include "radiosity/light/first_light.h"
#include "radiosity/transport/gathered_emission.h"
#include "radiosity/field/interpolation.h"
#include "radiosity/hierarchical/node_field.h"
#include "radiosity/hierarchical/node_solution.h"
#include "radiosity/solvers/shooting_blocks.h"
#include "radiosity/scene/surface_colour.h"
#include "scenes/materials/lobes.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

ClosureError closure_error(const std::vector<RowClosure>& rows) {
  ClosureError error;
  for (const auto& row : rows) {
    const double leak = std::abs(1.0 - (double{row.landed} + row.escaped + row.black + row.cut));
    error.mean_error += leak / double(rows.size());
    error.max_error = std::max(error.max_error, leak);
    error.cut +=
        glm::max(row.cut_light.r, glm::max(row.cut_light.g, row.cut_light.b)) / double(rows.size());
  }
  return error;
}

Rgb passed_on(const LightScene& light, MaterialId id) {
  const Material& material = light.scene.materials[index(id)];
  if (!is_glass(material) && !has_mirror_coat(material))
    return mirror_reflectance(material);
  const GlassShares mean = mean_shares(light.by_angle[index(id)]);
  return mean.reflected + mean.passed;
}

/// Of the light that elements receive, what the mirror,
/// the glass or the coat that they are as well passes on: rays carry it.
std::vector<Rgb> passed_on_by_elements(const LightScene& light) {
  const ElementMesh& mesh = light.mesh;
  std::vector<Rgb> shares(mesh.area.size());
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const MeshSide& side = mesh.sides[s];
    const auto first = shares.begin() + side.first_element;
    if (side.textured && is_glass(light.scene.materials[index(side.material)]))
      std::ranges::copy(passed_on_by_glass(light.scene, light.surfaces, light.textures, mesh,
                                           static_cast<SideId>(s)),
                        first);
    else
      std::fill_n(first, side.element_count, passed_on(light, side.material));
  }
  return shares;
}

/// What leaves an element follows the fractions of its own rays;
/// what is absorbed follows what the elements receive.
/// The two agree as far as the sampled form factors are reciprocal: the imbalance measures that.
/// Light that enters from outside the surfaces (of punctual lights,
/// of the background) counts as emitted where it first arrives.
EnergyBalance energy_balance(const LightScene& light, const RadiositySolution& solution,
                             const std::vector<RowClosure>& rows,
                             const std::vector<Rgb>& entering) {
  const ElementMesh& mesh = light.mesh;
  const std::vector<Rgb> carried_on = passed_on_by_elements(light);
  EnergyBalance energy;
  for (std::size_t i = 0; i < mesh.area.size(); ++i) {
    const double area = mesh.area[i] * solution.exposed[i];
    const Rgb leaving = area * solution.radiosity[i];
    energy.emitted += area * mesh.emission[i];
    if (!entering.empty())
      energy.emitted += area * entering[i];
    const Rgb kept = 1.0 - mesh.reflectance[i] - carried_on[i];
    energy.absorbed += area * kept * solution.irradiance[i];
    const Rgb followed = leaving / glm::max(Rgb(1e-9), 1.0 - Rgb(rows[i].cut_light));
    energy.absorbed += Rgb(rows[i].black_light) * followed;
    energy.escaped += Rgb(rows[i].escaped_light) * followed;
    energy.mirror_absorbed += Rgb(rows[i].mirror_absorbed) * followed;
  }
  const Rgb left = energy.emitted - energy.absorbed - energy.escaped - energy.mirror_absorbed;
  for (int band = 0; band < 3; ++band) {
    if (energy.emitted[band] <= 0.0)
      continue;
    const double share = left[band] / energy.emitted[band];
    if (std::abs(share) > std::abs(energy.imbalance))
      energy.imbalance = share;
  }
  return energy;
}

/// The elements' own rays, as far as figures depend on them.
struct ElementRays {
  const std::vector<RowClosure>& closure;
  const std::vector<float>& exposed;
  std::uint64_t traced = 0;
};

/// Elements receive what their corners do, by ElementId; none where it is not they that tell.
void take_received(const ElementMesh& mesh, const std::vector<Rgb>& received,
                   RadiositySolution& solution) {
  for (std::size_t e = 0; e < received.size(); ++e) {
    if (!(solution.exposed[e] > 0.0F))
      continue;
    solution.irradiance[e] = received[e];
    solution.radiosity[e] = mesh.emission[e] + mesh.reflectance[e] * solution.irradiance[e];
  }
}

/// From what was reflected, and the irradiance that elements have sent one another,
/// to the solution with its field and figures.
/// With `receivers` vertices gather where these let them (hierarchical/node_field.h),
/// and elements receive what vertices do, but for spots (hierarchical/node_light.h).
void complete(const LightScene& light, const PassOneSettings& settings, const FirstLight& first,
              const std::vector<Rgb>& arrived, const ElementRays& rays, RadiositySolution& solution,
              HierarchicalSolution* receivers = nullptr) {
  const ElementMesh& mesh = light.mesh;
  Stopwatch watch;

  // H = first light + T B, and B = E + what is reflected.
  std::vector<Rgb> reflected = std::move(solution.solver.radiosity);
  solution.irradiance = arrived;
  solution.radiosity = reflected;
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    solution.irradiance[i] += first.irradiance[i];
    solution.radiosity[i] += mesh.emission[i];
  }

  const ElementLight elements{std::move(reflected), solution.irradiance, first.from_source};
  auto interpolated =
      receivers != nullptr
          ? field_by_nodes(light, elements, *receivers,
                           {settings.form_factors, settings.direct, settings.interpolation})
          : interpolate(light, elements, settings.form_factors, settings.direct,
                        settings.interpolation);
  solution.field = std::move(interpolated.field);
  solution.interpolation_error = interpolated.error;
  if (interpolated.mesh)
    solution.refined = make_refined_scene(light, std::move(*interpolated.mesh));
  solution.seconds.interpolate = watch.lap();
  solution.exposed = rays.exposed;
  take_received(mesh, interpolated.received, solution);

  solution.closure = closure_error(rays.closure);
  solution.energy = energy_balance(light, solution, rays.closure, first.entering);
  solution.form_factor_rays = rays.traced + interpolated.form_factor_rays;
  solution.shadow_rays = first.shadow_rays + interpolated.shadow_rays;
}

/// The watch of shots, shown the field there is so far; adds up the time that takes.
ShotWatch watched(const LightScene& light, const PassOneSettings& settings, const FirstLight& first,
                  const ElementRays& rays, const PassOneWatch& watch, double& seconds) {
  std::vector<double> area = light.mesh.area;
  for (std::size_t i = 0; i < area.size(); ++i)
    area[i] *= double{rays.exposed[i]};
  const auto look = [&, area = std::move(area)](const ShotsSoFar& shots) {
    Stopwatch stopwatch;
    std::vector<Rgb> irradiance = shots.arrived;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
      irradiance[i] += first.irradiance[i];
    const auto interpolated =
        interpolate(light, {{}, std::move(irradiance), first.from_source}, settings.form_factors,
                    settings.direct, {Interpolation::average});
    watch.look({shots.shots, interpolated.field,
                ambient_irradiance(area, rays.closure, shots.unshot, first.reflectance)});
    seconds += stopwatch.lap();
  };
  return {watch.every, look};
}

} // namespace

RadiositySolution shoot_pass_one(const LightScene& light, const PassOneSettings& settings,
                                 const Progress& progress, const PassOneWatch& watch) {
  RadiositySolution solution;
  Stopwatch stopwatch;
  const HemisphereSurvey survey = survey_hemispheres(light, settings.form_factors, progress);
  const FirstLight first = first_light(light, survey.gathered, survey.closure, survey.covered,
                                       settings.form_factors.method, settings.direct, progress);
  solution.seconds.form_factors = stopwatch.lap();

  const ElementRays own{survey.closure, survey.exposed};
  double watching = 0.0;
  ShotSolution shots = solve_by_shots(light, survey, first.source, first.reflectance,
                                      settings.form_factors, settings.solver, progress,
                                      watched(light, settings, first, own, watch, watching));
  solution.solver = std::move(shots.solver);
  solution.seconds.solve = stopwatch.lap() - watching;
  complete(light, settings, first, shots.arrived,
           {survey.closure, survey.exposed, survey.rays_traced + shots.rays_traced}, solution);
  return solution;
}

/// Pass one by receivers of many sizes.
static RadiositySolution link_pass_one(const LightScene& light, const PassOneSettings& settings,
                                       const Progress& progress) {
  const bool vertices_gather = gathers_by_nodes(settings);
  Stopwatch watch;
  std::optional<LitVertices> vertices;
  if (vertices_gather)
    vertices =
        lit_vertices(light, {settings.form_factors, settings.direct, settings.interpolation});
  const double lighting = watch.lap();
  NodeSolution nodes =
      solve_by_nodes(light, settings.form_factors, settings.direct, settings.hierarchical,
                     std::move(vertices), settings.solver, progress);
  RadiositySolution solution;
  solution.solver = std::move(nodes.solver);
  solution.links = nodes.figures;
  solution.seconds.form_factors = lighting + nodes.seconds_gathering;
  solution.seconds.solve = nodes.seconds_solving;
  complete(light, settings, nodes.first, nodes.arrived,
           {nodes.closure, nodes.exposed, nodes.rays_traced}, solution,
           vertices_gather ? &nodes.receivers : nullptr);
  return solution;
}

bool gathers_by_nodes(const PassOneSettings& settings) {
  return settings.solver.method == SolverMethod::hierarchical &&
         settings.interpolation.method == Interpolation::gather && !settings.interpolation.adaptive;
}

bool shoots_rays(const PassOneSettings& settings, std::size_t elements) {
  return settings.solver.method == SolverMethod::progressive &&
         settings.form_factors.method == FormFactorMethod::rays && elements > max_direct_unknowns;
}

RadiositySolution solve_pass_one(const LightScene& light, const PassOneSettings& settings,
                                 const Progress& progress, const PassOneWatch& watch) {
  check_size(settings.solver.method, element_count(light.mesh));
  if (shoots_rays(settings, element_count(light.mesh)))
    return shoot_pass_one(light, settings, progress, watch);
  if (settings.solver.method == SolverMethod::hierarchical)
    return link_pass_one(light, settings, progress);
  Stopwatch stopwatch;
  const FormFactors factors = assemble_transport(light, settings.form_factors, progress);
  const double seconds = stopwatch.lap();
  RadiositySolution solution = solve_pass_one(light, factors, settings, progress, watch);
  solution.seconds.form_factors += seconds;
  return solution;
}

RadiositySolution solve_pass_one(const LightScene& light, const FormFactors& factors,
                                 const PassOneSettings& settings, const Progress& progress,
                                 const PassOneWatch& watch) {
  RadiositySolution solution;
  Stopwatch stopwatch;
  const ElementRays own{factors.closure, factors.exposed, factors.rays_traced};

  // Eq. 1, split by who owns the path:
  // direct light, gathered emission, and reflected light by the transport.
  const FirstLight first =
      first_light(light, gathered_emission(light, factors), factors.closure, factors.covered,
                  settings.form_factors.method, settings.direct, progress);
  solution.seconds.form_factors = stopwatch.lap();

  double watching = 0.0;
  ShotPlan plan;
  if (settings.solver.method == SolverMethod::progressive)
    plan = {make_shooting_blocks(light.mesh, factors.exposed),
            watched(light, settings, first, own, watch, watching)};
  solution.solver =
      solve(factors.transport, first.source, first.reflectance, settings.solver, plan);
  const std::vector<Rgb> arrived = apply_transport(factors.transport, solution.solver.radiosity);
  solution.seconds.solve = stopwatch.lap() - watching;
  complete(light, settings, first, arrived, own, solution);
  return solution;
}

std::vector<NodeLight> light_by_node(const Scene& scene, const ElementMesh& mesh,
                                     const RadiositySolution& solution) {
  std::vector<NodeLight> nodes(scene.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    nodes[n].name = scene.nodes[n].name;
  for (std::size_t i = 0; i < mesh.area.size(); ++i) {
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[i])];
    NodeLight& node = nodes[index(side.node)];
    node.area += mesh.area[i];
    node.emitted += mesh.area[i] * mesh.emission[i];
    node.radiosity += mesh.area[i] * solution.exposed[i] * solution.radiosity[i];
    node.irradiance += mesh.area[i] * solution.exposed[i] * solution.irradiance[i];
  }
  for (auto& node : nodes) {
    if (node.area <= 0.0)
      continue;
    node.emitted /= node.area;
    node.radiosity /= node.area;
    node.irradiance /= node.area;
  }
  return nodes;
}

} // namespace meninas
