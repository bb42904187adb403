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

} // namespace meninas
