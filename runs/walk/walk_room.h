// The room as triangles with their light, as a page draws it.
//
// Faces that receive light are the triangles of the field's elements (radiosity/solution/
// element_triangles.h), with the irradiance H, W/m^2, at their corners: the field itself, linear
// between them (walk_light.h).
//
// If the field knows lamps apart, the same is there for each of them: H = sum of H_l.
//
// Faces without a field (ideal mirrors, panes, dark sides) are the scene's triangles. All fronts are
// counter-clockwise. The backs of single-sided surfaces are not there: the eye looks through them,
// and by way of a mirror they are black.
//
// Triangles are sorted so that what is drawn alike is in a row: by section, textures, mirror, node.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "runs/walk/walk_light.h"
#include "runs/walk/walk_looks.h"

#include <vector>

namespace meninas {

enum class WalkSection {
  single, ///< opaque, its back black to mirrors
  both,   ///< opaque, or with holes, and its back is a face of its own, or open
  pane    ///< blended over what is behind it
};

struct WalkVertex {
  glm::vec3 position{0.0F}; ///< metres, from the middle of the scene
  glm::vec3 irradiance{0.0F};
  glm::vec3 normal{0.0F}; ///< of curved mirrors and solids alone
  glm::vec2 colour_place{0.0F}, emission_place{0.0F}; ///< on the two textures
  glm::vec4 colour{1.0F};
  std::uint32_t look = 0;
};

/// A run of triangles that are drawn in one call.
struct WalkBatch {
  WalkSection section = WalkSection::single;
  TextureId colour = none<TextureId>, emission = none<TextureId>;
  MirrorId mirror = none<MirrorId>;
  NodeId node = none<NodeId>;
  bool shows_round = false; ///< what the middle of its body sees: curved mirrors, solids
  std::uint32_t first = 0, count = 0; ///< triangles
};

struct WalkRoom {
  Point3 middle{0.0};
  std::vector<WalkVertex> vertices;
  std::vector<LightOrigin> origins; ///< by vertex
  std::vector<std::uint32_t> indices; ///< three to a triangle
  std::vector<std::uint32_t> element_ends; ///< triangles of an element follow one another: where they end
  std::vector<ElementId> elements; ///< by entry of `element_ends`; none of faces without a field
  std::vector<WalkBatch> batches;
  std::vector<WalkLook> looks;
  std::vector<std::vector<glm::vec3>> irradiance_by_lamp; ///< by lamp and vertex; empty: not known apart
};

WalkRoom walk_room(const IrradianceField& field);

/// H by vertex.
std::vector<glm::vec3> irradiance_of(const WalkRoom& room);

} // namespace meninas
