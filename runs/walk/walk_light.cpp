#include "runs/walk/walk_light.h"

namespace meninas {

glm::vec3 irradiance_from(const LightScene& light, const VertexIrradiance& field,
                          const LightOrigin& origin) {
  glm::vec3 own(0.0F);
  for (std::size_t k = 0; k < 4; ++k)
    own += origin.weights[k] * field.irradiance[origin.vertices[k]];
  const SideId behind = side_behind(light.mesh, origin.side);
  if (behind == none<SideId>)
    return own;
  const MeshSide& side = light.mesh.sides[index(origin.side)];
  const Patch& patch = light.surfaces.patches[index(side.patch)];
  const glm::vec3 passed = irradiance_at(light.mesh, field, behind, uv_at(patch, origin.place));
  const glm::vec3 ratio(side.transmittance / glm::max(side.reflectance, Rgb(1e-6)));
  return own + glm::min(ratio, glm::vec3(1e3F)) * passed;
}

std::vector<glm::vec3> irradiance_from(const LightScene& light, const VertexIrradiance& field,
                                       std::span<const LightOrigin> origins) {
  std::vector<glm::vec3> irradiance(origins.size(), glm::vec3(0.0F));
  for (std::size_t v = 0; v < origins.size(); ++v)
    if (origins[v].side != none<SideId>)
      irradiance[v] = irradiance_from(light, field, origins[v]);
  return irradiance;
}

} // namespace meninas
