#include "radiosity/scene/small_elements.h"

#include "radiosity/mesh/small_surfaces.h"

#include <algorithm>

namespace meninas {

static bool is_small(const LightScene& light, ElementId element) {
  const ElementMesh& mesh = light.mesh;
  return is_small(mesh, mesh.sides[index(mesh.side_of_element[index(element)])]);
}

bool has_reduced_rays(const LightScene& light, ElementId element) {
  return light.finely_tessellated && is_small(light, element);
}

bool has_reduced_samples(const LightScene& light, ElementId element) {
  constexpr double small_share = 1.0 / 64.0; // of all light
  const Rgb& emission = light.mesh.emission[index(element)];
  if (emission == Rgb(0.0))
    return has_reduced_rays(light, element);
  return is_small(light, element) && !light.emitter_tree.nodes.empty() &&
         light.mesh.area[index(element)] * std::max({emission.r, emission.g, emission.b}) <=
             small_share * light.emitter_tree.nodes[0].power;
}

std::size_t sampled_elements(const LightScene& light) {
  std::size_t eighths = 0;
  for (std::uint32_t e = 0; e < element_count(light.mesh); ++e)
    eighths += has_reduced_samples(light, ElementId{e}) ? 1 : 8;
  return eighths / 8;
}

} // namespace meninas
