// The diffuse term of pass two: outgoing radiance of the field of pass one at a landing point,
//   L = L_e + (rho_d H + tau_d H_behind) / pi,
// H_behind what the other side of a translucent surface receives at the same place,
// the one place where radiosity becomes radiance.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/scene/light_scene.h"

#include <span>
#include <string>
#include <vector>

namespace meninas {

struct SideShading {
  glm::vec3 emitted{0.0F};        ///< L_e
  glm::vec3 albedo_over_pi{0.0F}; ///< rho_d / pi
  bool textured = false; ///< these are factors: each point has its own (shading_at)
  glm::vec3 passed_over_pi{0.0F}; ///< tau_d / pi of a translucent surface

  /// Whether a point shows more than its place in the field tells.
  bool is_by_point() const { return textured || passed_over_pi != glm::vec3(0.0F); }
};

/// By SideId.
std::vector<SideShading> make_side_shading(const Scene& scene, const ElementMesh& mesh);

/// The part of the arriving light that is reflected, by its last leg: straight or by way of mirrors.
enum class ReflectedPart { all, straight, mirrored, none };

/// The radiance that landing points show. Refers to its field.
struct VisibleLight {
  std::vector<SideShading> shading;  ///< by SideId
  std::vector<glm::vec3> irradiance; ///< by ElementVertexId: of the part, all of it or the indirect
  const ElementTable& lookup;        ///< of the field, as the next
  std::span<const ElementCorners> corners; ///< by cell
  ReflectedPart part = ReflectedPart::all;
  glm::vec3 background{0.0F}; ///< radiance where nothing is met, from everywhere
  const RadianceMap* sky = nullptr; ///< the same by direction
};

/// The part of the light in a field's values.
enum class FieldContent {
  all,
  indirect ///< without direct light
};

VisibleLight visible_light(const IrradianceField& field,
                           FieldContent content);

/// A part of the light that a field shows. The parts add up to it: `emission`, and reflected light by its last
/// leg to the surface, straight (`diffuse.direct`) or by way of mirrors (`diffuse.mirrored`).
struct LightPart {
  std::string name;
  VisibleLight light;
};
/// Where nothing is met the background is seen, as `emission`.
std::vector<LightPart> light_parts(const IrradianceField& field,
                                   FieldContent content);

/// Sums over points (s, t) of one cell: of 1, s, t and s t. The field is linear in them.
struct PointSums {
  float n = 0.0F, s = 0.0F, t = 0.0F, st = 0.0F;
};

/// The sum of the irradiances at points of a cell.
/// Points of a triangle have no sum of s t: its third corner stands for its fourth, so the bilinear
/// form without the product s t is the linear one.
inline glm::vec3 field_irradiance(std::span<const ElementCorners> cells,
                                  std::span<const glm::vec3> irradiance, std::uint32_t cell,
                                  const PointSums& p) {
  const auto& corners = cells[cell];
  const glm::vec3& h0 = irradiance[index(corners[0])];
  const glm::vec3& h1 = irradiance[index(corners[1])];
  const glm::vec3& h2 = irradiance[index(corners[2])];
  const glm::vec3& h3 = irradiance[index(corners[3])];
  return (p.n - p.s - p.t + p.st) * h0 + (p.s - p.st) * h1 + p.st * h2 + (p.t - p.st) * h3;
}


/// The one point (u, v) of a side.
struct FieldPoint {
  std::uint32_t element; ///< or cell of the field
  PointSums place;
};
inline FieldPoint field_point(const ElementTable& lookup, std::uint32_t side, glm::vec2 uv) {
  const Landing at = land(lookup, side, uv);
  const float st = lookup.sides[side].triangle ? 0.0F : at.st.x * at.st.y;
  return {at.element, {1.0F, at.st.x, at.st.y, st}};
}

inline glm::vec3 field_irradiance(const VisibleLight& visible, std::uint32_t side, glm::vec2 uv) {
  const FieldPoint at = field_point(visible.lookup, side, uv);
  return field_irradiance(visible.corners, visible.irradiance, at.element, at.place);
}

} // namespace meninas
