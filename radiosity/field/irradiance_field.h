// The irradiance field: values at the vertices of a mesh, bilinear in quads, linear in triangles.
//
// It is irradiance H, W/m^2, on every side of every patch; reflectance is applied at the hit:
//
//   B(x) = E(x) + rho(x) H(x)
//
// On translucent surfaces tau(x) H(x) of the other side is added, at the same (u, v).
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/translucency.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meninas {

/// The irradiance from one lamp (scene/lamp_shares.h), by ElementVertexId, W/m^2.
struct VertexLightOfLamp {
  std::vector<glm::vec3> direct;   ///< D (light/direct_irradiance.h)
  std::vector<glm::vec3> indirect; ///< H - D
};

/// By ElementVertexId of one mesh, W/m^2.
struct VertexIrradiance {
  std::vector<glm::vec3> irradiance;
  std::vector<glm::vec3>
      mirrored; ///< the part of it whose last leg came by way of mirrors; empty from `average`, and where nobody asks

  /// Indirect irradiance, H without D (direct_irradiance.h), for those who compute
  /// that themselves; empty where that is not known: from `average` with form factors `analytic`.
  std::vector<glm::vec3> indirect;
  std::vector<glm::vec3> indirect_mirrored; ///< likewise of `mirrored`

  /// By lamp, parts of `irradiance` and `indirect` that add up to them; empty: not told apart.
  std::vector<VertexLightOfLamp> by_lamp = {};
};

/// Cells between whose corners a field is interpolated, where these are finer than the elements of its mesh.
struct FieldCells {
  ElementTable lookup;                 ///< from (u, v) of a side to the cell
  std::vector<ElementCorners> corners; ///< by cell: the elements first, then their parts
};

/// The values with the scene on whose mesh they are, which is finer than the mesh that was solved
/// where elements were divided for the field.
struct IrradianceField : VertexIrradiance {
  std::shared_ptr<const LightScene> scene;
  std::shared_ptr<const FieldCells> cells = nullptr; ///< null: the elements (view_field.h). Vertices of theirs come after those of the mesh

  const ElementMesh& mesh() const { return scene->mesh; }
  const ElementTable& lookup() const { return cells ? cells->lookup : scene->landing.elements; }
  std::span<const ElementCorners> corners() const {
    return cells ? cells->corners : scene->mesh.corners;
  }
};

struct InterpolatedField {
  VertexIrradiance field;
  std::optional<ElementMesh> mesh = {}; ///< where it is finer than that of the elements
  std::vector<Rgb> received = {}; ///< H by ElementId where elements receive what their corners do, by nodes; empty otherwise
  std::uint64_t form_factor_rays = 0;
  std::uint64_t shadow_rays = 0;
};

/// The light of the elements, by ElementId, W/m^2.
struct ElementLight {
  std::vector<Rgb> reflected;   ///< B without emission
  std::vector<Rgb> irradiance;  ///< H
  std::vector<Rgb> direct; ///< D, a part of H; empty: not known
  TranslucentLinks translucent = {}; ///< what comes through from one to another
  LightByLamp by_lamp = {}, irradiance_by_lamp = {},
      direct_by_lamp = {}; ///< of these, in proportion; empty where light is not told apart
};

/// The field at a point of a side.
glm::vec3 irradiance_at(const ElementMesh& mesh, const VertexIrradiance& field, SideId side, Vec2 uv);

} // namespace meninas
