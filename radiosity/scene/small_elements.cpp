#include "radiosity/scene/small_elements.h"

#include "radiosity/mesh/small_surfaces.h"

#include <algorithm>

namespace meninas {

bool needs_few_samples(const LightScene& light, ElementId element) {
  constexpr double small_share = 1.0 / 64.0; // of all light
  const ElementMesh& mesh = light.mesh;
  const std::size_t e = index(element);
  if (!is_small(mesh, mesh.sides[index(mesh.side_of_element[e])]))
    return false;
  const Rgb& emission = mesh.emission[e];
  if (emission == Rgb(0.0))
    return light.finely_tessellated;
  return !light.emitter_tree.nodes.empty() &&
         mesh.area[e] * std::max({emission.r, emission.g, emission.b}) <=
             small_share * light.emitter_tree.nodes[0].power;
}

} // namespace meninas
