// The diffuse term of pass two: outgoing radiance of the field of pass one at a landing point,
//   L = L_e + rho_d H / pi,
// the one place where radiosity becomes radiance.
#pragma once

#include "radiosity/interpolation.h"

#include <vector>

namespace meninas {

struct SideShading {
  glm::vec3 emitted{0.0F};         ///< L_e
  glm::vec3 albedo_over_pi{0.0F};  ///< rho_d / pi
};

/// By SideId.
std::vector<SideShading> make_side_shading(const ElementMesh& mesh);

/// In an element at (s, t), where st is s t, or the three are means over several points of a quad element.
inline glm::vec3 field_radiance(const ElementMesh& mesh, const DiffuseField& field, const SideShading& shading,
                                std::uint32_t element, float s, float t, float st) {
  const auto& corners = mesh.corners[element];
  const glm::vec3& h0 = field.irradiance[index(corners[0])];
  const glm::vec3& h1 = field.irradiance[index(corners[1])];
  const glm::vec3& h2 = field.irradiance[index(corners[2])];
  const glm::vec3& h3 = field.irradiance[index(corners[3])];
  const glm::vec3 h = (1.0F - s - t + st) * h0 + (s - st) * h1 + st * h2 + (t - st) * h3;
  return shading.emitted + shading.albedo_over_pi * h;
}

inline glm::vec3 field_radiance(const ElementMesh& mesh, const DiffuseField& field, const SideShading& shading,
                                const SideRecord& side, glm::vec2 uv) {
  const Landing at = land(side, uv);
  // A triangle repeats its third corner as its fourth: without the product term the bilinear form is its linear one.
  return field_radiance(mesh, field, shading, at.element, at.st.x, at.st.y, side.triangle ? 0.0F : at.st.x * at.st.y);
}

} // namespace meninas
