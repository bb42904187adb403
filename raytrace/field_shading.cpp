#include "raytrace/field_shading.h"

#include <numbers>

namespace meninas {

std::vector<SideShading> make_side_shading(const ElementMesh& mesh) {
  std::vector<SideShading> shading;
  shading.reserve(mesh.sides.size());
  for (const auto& side : mesh.sides)
    shading.push_back({glm::vec3(side.emission / std::numbers::pi),
                       glm::vec3(side.reflectance / std::numbers::pi)});
  return shading;
}

std::vector<LightPart> light_parts(const ElementMesh& mesh, const DiffuseField& field) {
  const auto shading = make_side_shading(mesh);
  auto glowing = shading, reflecting = shading;
  for (auto& side : glowing)
    side.albedo_over_pi = glm::vec3(0.0F);
  for (auto& side : reflecting)
    side.emitted = glm::vec3(0.0F);

  std::vector<glm::vec3> straight = field.irradiance;
  for (std::size_t v = 0; v < straight.size(); ++v)
    straight[v] = glm::max(straight[v] - field.mirrored[v], glm::vec3(0.0F));
  return {{"emission", {glowing, field.irradiance}},
          {"diffuse.direct", {reflecting, std::move(straight)}},
          {"diffuse.mirrored", {reflecting, field.mirrored}}};
}

} // namespace meninas
