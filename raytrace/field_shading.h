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

inline glm::vec3 field_radiance(const ElementMesh& mesh, const DiffuseField& field, const SideShading& shading,
                                const SideRecord& side, glm::vec2 uv) {
  const Landing at = land(side, uv);
  const auto& corners = mesh.corners[at.element];
  const glm::vec3& h0 = field.irradiance[index(corners[0])];
  const glm::vec3& h1 = field.irradiance[index(corners[1])];
  const glm::vec3& h2 = field.irradiance[index(corners[2])];
  const float s = at.st.x, t = at.st.y;
  if (side.triangle) return shading.emitted + shading.albedo_over_pi * ((1.0F - s - t) * h0 + s * h1 + t * h2);
  const glm::vec3& h3 = field.irradiance[index(corners[3])];
  const glm::vec3 low = h0 + s * (h1 - h0), high = h3 + s * (h2 - h3);
  return shading.emitted + shading.albedo_over_pi * (low + t * (high - low));
}

} // namespace meninas
