#include "radiosity/pass_one.h"

#include "radiosity/gathered_emission.h"
#include "scenes/stopwatch.h"

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

/// What leaves an element follows the fractions of its own rays; what is absorbed follows what the elements receive. The two agree as
/// far as the sampled form factors are reciprocal: the imbalance measures that.
EnergyBalance energy_balance(const ElementMesh& mesh, const RadiositySolution& solution,
                             const std::vector<RowClosure>& rows) {
  EnergyBalance energy;
  for (std::size_t i = 0; i < mesh.area.size(); ++i) {
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[i])];
    const double area = mesh.area[i] * solution.exposed[i];
    const Rgb leaving = area * solution.radiosity[i];
    energy.emitted += area * side.emission;
    energy.absorbed += area * (1.0 - side.reflectance) * solution.irradiance[i];
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

/// The direct light that the transport has not gathered.
DirectIrradiance remaining_direct_light(const LightScene& light, const FormFactors& factors,
                                        const PassOneSettings& settings, const Progress& progress) {
  if (settings.form_factors.method == FormFactorMethod::analytic)
    return {std::vector<Rgb>(element_count(light.mesh), Rgb(0.0)), 0};
  return direct_irradiance(light, factors.covered, settings.direct, progress);
}

} // namespace

RadiositySolution solve_pass_one(const LightScene& light, const PassOneSettings& settings,
                                 const Progress& progress) {
  check_size(settings.solver.method, element_count(light.mesh));
  Stopwatch watch;
  const FormFactors factors = assemble_transport(light, settings.form_factors, progress);
  const double seconds = watch.lap();
  RadiositySolution solution = solve_pass_one(light, factors, settings, progress);
  solution.seconds.form_factors += seconds;
  return solution;
}

RadiositySolution solve_pass_one(const LightScene& light, const FormFactors& factors,
                                 const PassOneSettings& settings, const Progress& progress) {
  const ElementMesh& mesh = light.mesh;
  RadiositySolution solution;
  Stopwatch watch;

  // Eq. 1, split by who owns the path: direct light from the source, gathered emission, and reflected light by the transport.
  const std::vector<Rgb> gathered = gathered_emission(light, factors);
  const DirectIrradiance direct = remaining_direct_light(light, factors, settings, progress);
  solution.seconds.form_factors = watch.lap();

  std::vector<Rgb> first(mesh.area.size()), source(mesh.area.size()), reflectance(mesh.area.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    reflectance[i] = mesh.sides[index(mesh.side_of_element[i])].reflectance;
    first[i] = direct.irradiance[i] + gathered[i];
    source[i] = reflectance[i] * first[i];
  }
  solution.solver = solve(factors.transport, source, reflectance, settings.solver);
  std::vector<Rgb> reflected = std::move(solution.solver.radiosity);

  // H = first light + T B, and B = E + what is reflected.
  solution.irradiance = apply_transport(factors.transport, reflected);
  solution.radiosity = reflected;
  for (std::size_t i = 0; i < first.size(); ++i) {
    solution.irradiance[i] += first[i];
    solution.radiosity[i] += mesh.sides[index(mesh.side_of_element[i])].emission;
  }
  solution.seconds.solve = watch.lap();

  const bool source_known = settings.form_factors.method != FormFactorMethod::analytic;
  const ElementLight elements{std::move(reflected), solution.irradiance,
                              source_known ? direct.irradiance : std::vector<Rgb>{}};
  auto interpolated = interpolate(light, elements, settings.form_factors, settings.direct,
                                  settings.interpolation);
  solution.field = std::move(interpolated.field);
  solution.seconds.interpolate = watch.lap();
  solution.exposed = factors.exposed;

  solution.closure = closure_error(factors.closure);
  solution.energy = energy_balance(mesh, solution, factors.closure);
  solution.form_factor_rays = factors.rays_traced + interpolated.form_factor_rays;
  solution.shadow_rays = direct.shadow_rays + interpolated.shadow_rays;
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
    node.emitted += mesh.area[i] * side.emission;
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
