// Where the light of a page's vertices comes from, so that its triangles can be shown under any field of
// their mesh:
//
//   H(x) = sum over k of w_k H_k + (tau / rho) H_behind(x),      W/m^2
//
// a mean of vertices of the field, and of a translucent surface what would show the same from the front.
#pragma once

#include "radiosity/field/irradiance_field.h"

#include <array>
#include <span>
#include <vector>

namespace meninas {

/// A mean of the field's vertices, and a place of a side.
struct LightOrigin {
  SideId side = none<SideId>; ///< none: no light is known
  Point3 place{0.0};
  std::array<std::uint32_t, 4> vertices{};
  std::array<float, 4> weights{}; ///< 0 of those that are not there
};

/// H at an origin that has a side.
glm::vec3 irradiance_from(const LightScene& light, const VertexIrradiance& field,
                          const LightOrigin& origin);

/// The same of many; 0 where no light is known.
std::vector<glm::vec3> irradiance_from(const LightScene& light, const VertexIrradiance& field,
                                       std::span<const LightOrigin> origins);

} // namespace meninas
