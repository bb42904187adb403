#include "raytrace/field_shading.h"

#include "scenes/materials/coverage.h"

#include <numbers>

namespace meninas {

std::vector<SideShading> make_side_shading(const Scene& scene, const ElementMesh& mesh) {
  std::vector<SideShading> shading;
  shading.reserve(mesh.sides.size());
  for (const auto& side : mesh.sides) {
    const Material& material = scene.materials[index(side.material)];
    if (material.unlit)
      shading.push_back({glm::vec3(shown_radiance(material, untextured(material))),
                         glm::vec3(0.0F), side.textured});
    else
      shading.push_back({glm::vec3(side.emission / std::numbers::pi),
                         glm::vec3(side.reflectance / std::numbers::pi), side.textured,
                         glm::vec3(side.transmittance / std::numbers::pi)});
  }
  return shading;
}

VisibleLight visible_light(const IrradianceField& field,
                           FieldContent content) {
  return {make_side_shading(field.scene->scene, field.mesh()),
          content == FieldContent::all ? field.irradiance : field.indirect, field.lookup(),
          field.corners(), ReflectedPart::all,
          glm::vec3(field.scene->scene.background.constant), field.scene->sky};
}

std::vector<LightPart> light_parts(const IrradianceField& field,
                                   FieldContent content) {
  const VisibleLight all = visible_light(field, content);
  const auto& mirrored = content == FieldContent::all ? field.mirrored : field.indirect_mirrored;
  auto glowing = all.shading, reflecting = all.shading;
  for (auto& side : glowing)
    side.albedo_over_pi = side.passed_over_pi = glm::vec3(0.0F);
  for (auto& side : reflecting)
    side.emitted = glm::vec3(0.0F);

  std::vector<glm::vec3> straight = all.irradiance;
  for (std::size_t v = 0; v < straight.size(); ++v)
    straight[v] = glm::max(straight[v] - mirrored[v], glm::vec3(0.0F));
  const auto part = [&](auto& shading, std::vector<glm::vec3> irradiance,
                        ReflectedPart of) -> VisibleLight {
    return {shading, std::move(irradiance), all.lookup, all.corners, of, glm::vec3(0.0F), nullptr};
  };
  VisibleLight emission = part(glowing, all.irradiance, ReflectedPart::none);
  emission.background = all.background;
  emission.sky = all.sky;
  return {{"emission", std::move(emission)},
          {"diffuse.direct", part(reflecting, std::move(straight), ReflectedPart::straight)},
          {"diffuse.mirrored", part(reflecting, mirrored, ReflectedPart::mirrored)}};
}

} // namespace meninas
