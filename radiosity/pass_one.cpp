#include "radiosity/pass_one.h"

#include "radiosity/field/interpolation.h"
#include "radiosity/hierarchical/node_field.h"
#include "radiosity/radiosity_equation.h"
#include "radiosity/relight.h"
#include "radiosity/solvers/solve.h"
#include "scenes/stopwatch.h"

#include <algorithm>

namespace meninas {

namespace {

/// B = E + X and H = D + G + T X; X is kept for the field.
ElementSolution on_elements(const ElementMesh& mesh, const ReflectedLight& solved) {
  ElementSolution elements{solved.solver.radiosity, solved.arrived, solved.exposed};
  for (std::size_t i = 0; i < elements.radiosity.size(); ++i) {
    elements.irradiance[i] += solved.first.irradiance[i];
    elements.radiosity[i] += mesh.emission[i];
  }
  return elements;
}

/// Elements receive what their corners do, by ElementId; none where it is not they that tell.
void take_received(const ElementMesh& mesh, const TranslucentLinks& translucent,
                   const std::vector<Rgb>& received, ElementSolution& solution) {
  for (std::size_t e = 0; e < received.size(); ++e) {
    if (!(solution.exposed[e] > 0.0F))
      continue;
    solution.irradiance[e] = received[e];
    solution.radiosity[e] = mesh.emission[e] + mesh.reflectance[e] * solution.irradiance[e];
  }
  for (std::size_t e = 0; !translucent.empty() && e < received.size(); ++e)
    if (solution.exposed[e] > 0.0F)
      solution.radiosity[e] += passed_from_behind(translucent, e, solution.irradiance);
}

/// H at the vertices: D there, and indirect light gathered from the elements, by nodes where these say so.
/// Elements that are not seen may be less exact (pass_one.h).
InterpolatedField at_vertices(const LightScene& light, const PassOneSettings& settings,
                              ReflectedLight& solved, const std::vector<Rgb>& irradiance,
                              const SeenElements& seen, const Progress& progress) {
  const ElementLight elements{std::move(solved.solver.radiosity), irradiance,
                              solved.first.direct, solved.first.translucent,
                              std::move(solved.by_lamp), std::move(solved.irradiance_by_lamp),
                              std::move(solved.first.direct_by_lamp)};
  if (solved.receivers)
    return field_by_nodes(light, elements, *solved.receivers,
                          {settings.form_factors, settings.direct, settings.interpolation, progress,
                           seen.elements, seen.direct});
  return interpolate(light, elements, settings.form_factors, settings.direct,
                     settings.interpolation, progress);
}

/// Adds the figures of a solution that users are told beside its light.
void add_figures(const LightScene& light, ReflectedLight solved, const InterpolatedField& found,
                 double seconds_of_field, RadiositySolution& solution) {
  solution.seconds = {solved.form_factor_seconds, solved.solve_seconds, seconds_of_field};
  solution.closure = closure_error(solved.closure);
  solution.energy = energy_balance(light, solution, solved.closure, solved.first.entering);
  solution.solver = std::move(solved.solver);
  solution.links = solved.links;
  solution.form_factor_rays = solved.rays_traced + found.form_factor_rays;
  solution.shadow_rays = solved.first.shadow_rays + found.shadow_rays;
}

/// From X, the light that elements reflect, to the solution.
RadiositySolution solution_from(const std::shared_ptr<const LightScene>& light,
                                const PassOneSettings& settings, ReflectedLight solved,
                                const Progress& progress, const SeenElements& seen = {}) {
  Stopwatch watch;
  // On elements: B = E + X, H = D + G + T X.
  RadiositySolution solution;
  static_cast<ElementSolution&>(solution) = on_elements(light->mesh, solved);

  // At vertices: H(x) = D(x) + sum of tau F B, by one more gathering; elements may take the means of their corners.
  InterpolatedField found = at_vertices(*light, settings, solved, solution.irradiance, seen, progress);
  take_received(light->mesh, solved.first.translucent, found.received, solution);

  // The field, with the mesh on which it is.
  add_up_by_vertex(found.field);
  if (!settings.interpolation.mirrored)
    found.field.mirrored = found.field.indirect_mirrored = {};
  solution.field = {std::move(found.field),
                    found.mesh ? light_scene_on(light, std::move(*found.mesh)) : light};
  add_figures(*light, std::move(solved), found, watch.lap(), solution);
  return solution;
}

/// E = 0, and so B = H = 0 without a row.
RadiositySolution darkness(const std::shared_ptr<const LightScene>& light,
                           const PassOneSettings& settings) {
  const std::vector<Rgb> zeros(element_count(light->mesh), Rgb(0.0));
  const std::vector<glm::vec3> at_vertices(light->mesh.vertices.size(), glm::vec3(0.0F));
  RadiositySolution solution;
  solution.radiosity = solution.irradiance = zeros;
  solution.exposed.assign(zeros.size(), 1.0F);
  const auto mirrored = settings.interpolation.mirrored ? at_vertices : std::vector<glm::vec3>{};
  solution.field = {{at_vertices, mirrored, at_vertices, mirrored}, light};
  solution.solver.method = settings.solver.method;
  solution.solver.bands = 1;
  solution.solver.converged = true;
  solution.field.by_lamp.assign(light->lamps.count, {at_vertices, at_vertices});
  if (settings.cut == MeshCut::hierarchical)
    solution.links.emplace();
  return solution;
}

} // namespace

bool nothing_emits(const LightScene& light) {
  return light.emitters.empty() && light.punctual.empty() && light.background == Rgb(0.0) &&
         light.sky == nullptr &&
         std::ranges::all_of(light.mesh.emission,
                             [](const Rgb& emission) { return emission == Rgb(0.0); });
}

RadiositySolution solve_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const Progress& progress,
                                 const PassOneWatch& watch) {
  return solve_for_view(light, settings, {}, progress, watch);
}

RadiositySolution solve_for_view(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const SeenElements& seen,
                                 const Progress& progress, const PassOneWatch& watch) {
  if (settings.cut == MeshCut::uniform)
    check_size(settings.solver.method, element_count(light->mesh));
  if (nothing_emits(*light))
    return darkness(light, settings);

  // X = rho (D + G) + rho T X on the cut (Eq. 1); from it B and H on elements, and H at vertices.
  ReflectedLight solved = reflected_light(*light, settings, progress, watch, seen.elements);
  return solution_from(light, settings, std::move(solved), progress, seen);
}

RadiositySolution solve_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const FormFactors& factors, const PassOneSettings& settings,
                                 const Progress& progress, const PassOneWatch& watch) {
  return solution_from(light, settings, reflected_by_rows(*light, factors, settings, progress, watch),
                       progress);
}

RadiositySolution shoot_pass_one(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const Progress& progress,
                                 const PassOneWatch& watch) {
  return solution_from(light, settings, reflected_by_shots(*light, settings, progress, watch), progress);
}

} // namespace meninas
