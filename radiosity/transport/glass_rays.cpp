#include "radiosity/transport/glass_rays.h"

#include "radiosity/scene/surface_colour.h"
#include "scenes/materials/refraction.h"

namespace meninas {

static MaterialId material_id(const LightScene& light, TriangleId triangle) {
  return light.scene.triangles[index(triangle)].material;
}

Bsdf solid_face(const LightScene& light, TriangleId triangle, Vec2 barycentric, bool front) {
  const Material& material = material_of(light.scene, triangle);
  Bsdf face = light.solids.faces[index(material_id(light, triangle))];
  if (is_textured(material) || has_vertex_colors(light.scene, triangle)) {
    MaterialPoint point = material_at(light.scene, light.textures, triangle, barycentric);
    point.thickness = 0.0; // what it absorbs goes by the metres
    face = clear_glass(material, point);
  }
  return front ? face : from_behind(face);
}

std::optional<Direction> refracted(const LightScene& light, TriangleId triangle, bool front,
                                   const Direction& normal, const Vec3& direction) {
  const Bsdf& face = light.solids.faces[index(material_id(light, triangle))];
  const Glass pane = front ? face.pane : from_behind(face).pane;
  const auto behind = direction_behind(pane, local_out(normal, glm::normalize(direction)));
  return behind ? std::optional(to_world(normal, *behind)) : std::nullopt;
}

MaterialId medium_behind(const LightScene& light, TriangleId triangle, bool front) {
  return front ? material_id(light, triangle) : none<MaterialId>;
}

glm::vec3 left_by_solid(const LightScene& light, TriangleId met, bool front, MaterialId before,
                        double metres) {
  if (met == none<TriangleId>)
    return glm::vec3(1.0F);
  const MaterialId own = material_id(light, met);
  const bool inside = !front && is_solid_glass(light.scene.materials[index(own)]);
  const MaterialId solid = inside ? own : before;
  return solid == none<MaterialId>
             ? glm::vec3(1.0F)
             : glm::vec3(attenuation(light.scene.materials[index(solid)], metres));
}

} // namespace meninas
