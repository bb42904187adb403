#include "radiosity/field/irradiance_field.h"

#include "radiosity/field/vertex_places.h"

namespace meninas {

glm::vec3 irradiance_at(const ElementMesh& mesh, const VertexIrradiance& field, SideId side, Vec2 uv) {
  return value_in(mesh, field.irradiance, locate(mesh, side, uv));
}

} // namespace meninas
