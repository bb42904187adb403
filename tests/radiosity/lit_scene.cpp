#include "tests/radiosity/lit_scene.h"

#include "radiosity/mesh/make_mesh.h"

namespace meninas::test {

std::unique_ptr<LitScene> lit(Scene scene, const MeshSettings& mesh, const PlanSettings& plan) {
  auto lit = std::make_unique<LitScene>();
  lit->scene = std::move(scene);
  lit->surfaces = find_surfaces(lit->scene);
  lit->plan = plan_transport(lit->scene, lit->surfaces, plan);
  lit->rays.emplace(make_ray_scene(lit->scene, lit->surfaces));
  lit->mesh = make_element_mesh(lit->scene, lit->surfaces, mesh);
  lit->light = std::make_shared<const LightScene>(make_light_scene(
      lit->scene, lit->surfaces, *lit->rays, {lit->plan.mirrors, lit->plan.worlds}, lit->mesh));
  return lit;
}

static bool belongs(const LitScene& lit, std::size_t element, const std::string& node) {
  const MeshSide& side = lit.mesh.sides[index(lit.mesh.side_of_element[element])];
  return lit.scene.nodes[index(side.node)].name == node;
}

std::vector<std::size_t> elements_of(const LitScene& lit, const std::string& node) {
  std::vector<std::size_t> elements;
  for (std::size_t e = 0; e < element_count(lit.mesh); ++e)
    if (belongs(lit, e, node))
      elements.push_back(e);
  return elements;
}

double form_factor(const LitScene& lit, const Transport& transport, const std::string& from,
                   const std::string& to) {
  std::vector<double> on_target(transport.size, 0.0);
  for (const std::size_t e : elements_of(lit, to))
    on_target[e] = 1.0;
  double sum = 0.0, area = 0.0;
  for (const std::size_t e : elements_of(lit, from)) {
    area += lit.mesh.area[e];
    for (auto k = transport.row_begin[e]; k < transport.row_begin[e + 1]; ++k)
      sum += lit.mesh.area[e] *
             double{transport.weights[k * static_cast<std::size_t>(transport.bands)]} *
             on_target[transport.columns[k]];
  }
  return sum / area;
}

Rgb mean_over(const LitScene& lit, const std::vector<Rgb>& values, const std::string& node) {
  Rgb sum(0.0);
  double area = 0.0;
  for (const std::size_t e : elements_of(lit, node)) {
    sum += lit.mesh.area[e] * values[e];
    area += lit.mesh.area[e];
  }
  return sum / area;
}

} // namespace meninas::test
