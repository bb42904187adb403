#include "radiosity/energy.h"

#include "radiosity/scene/surface_colour.h"
#include "radiosity/transport/translucency.h"
#include "scenes/materials/lobes.h"

#include <algorithm>
#include <cmath>

namespace meninas {

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

namespace {

Rgb passed_on(const LightScene& light, MaterialId id) {
  const Material& material = light.scene.materials[index(id)];
  if (!is_glass(material) && !has_mirror_coat(material))
    return mirror_reflectance(material);
  const GlassShares mean = mean_shares(light.by_angle[index(id)]);
  return mean.reflected + mean.passed;
}

/// The part of the elements' irradiance that their own mirror, glass or coat passes on: rays carry it.
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

/// The part of that light that comes out behind translucent surfaces.
std::vector<Rgb> passed_by_elements(const ElementMesh& mesh, const std::vector<float>& exposed) {
  const TranslucentLinks links = translucent_links(mesh, exposed);
  if (links.empty())
    return {};
  std::vector<double> areas = mesh.area;
  for (std::size_t e = 0; e < areas.size(); ++e)
    areas[e] *= double{exposed[e]};
  return passed_on(links, areas, std::vector<Rgb>(areas.size(), Rgb(1.0)));
}

} // namespace

EnergyBalance energy_balance(const LightScene& light, const ElementSolution& solution,
                             const std::vector<RowClosure>& rows,
                             const std::vector<Rgb>& entering) {
  const ElementMesh& mesh = light.mesh;
  const std::vector<Rgb> carried_on = passed_on_by_elements(light);
  const std::vector<Rgb> passed = passed_by_elements(mesh, solution.exposed);
  EnergyBalance energy;
  for (std::size_t i = 0; i < mesh.area.size(); ++i) {
    const double area = mesh.area[i] * solution.exposed[i];
    const Rgb leaving = area * solution.radiosity[i];
    energy.emitted += area * mesh.emission[i];
    if (!entering.empty())
      energy.emitted += area * entering[i];
    const Rgb kept = passed.empty() ? 1.0 - mesh.reflectance[i] - carried_on[i]
                                    : 1.0 - mesh.reflectance[i] - carried_on[i] - passed[i];
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

std::vector<NodeLight> light_by_node(const Scene& scene, const ElementMesh& mesh,
                                     const ElementSolution& solution) {
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
