// The triangles of a solved scene for a glTF viewer, by node, material and kind.
//
//   lit     the elements, with the radiosity of pass one as their unlit colour
//   lobe    ideal mirrors, metals that pass one takes for them, and glass, as the file's own material
//   dark    faces that no light reaches: black, so that there is no hole
//
// Their points are the vertices of the mesh, and after them those that a piece has for itself: points
// on outlines of regions, and the corners of what has a texture, vertex colours or alpha, since
// one vertex of the mesh may be at several places of a texture. Points of lobe and dark pieces are
// in lists of their own. Positions are metres, triangles counter-clockwise seen from their front.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/solution/element_triangles.h"

#include <array>
#include <vector>

namespace meninas {

enum class ShownAs : std::uint8_t { lit, lobe, dark };

struct ShownPiece {
  NodeId node = none<NodeId>;
  MaterialId material = none<MaterialId>;
  ShownAs shown_as = ShownAs::lit;
  bool dressed = false; ///< lit, and its colour is that of its points times texture and vertex colour
  std::vector<std::uint32_t> indices; ///< three to a triangle, in the list of its points
};

/// A point of a lit piece that is no vertex of the mesh.
struct ShownPoint {
  RegionPoint at;
  glm::vec2 texcoord{0.0F};
  glm::vec4 colour{1.0F}; ///< COLOR_0 of the scene's file
};

/// A point of a lobe or dark piece.
struct PlainPoint {
  Point3 position{0.0};
  glm::vec3 normal{0.0F};
  glm::vec2 texcoord{0.0F};
};

struct ShownFaces {
  std::vector<ShownPiece> pieces;  ///< by node, then material, then kind
  std::vector<ShownPoint> points;  ///< of lit pieces, from `mesh.vertices.size()` on
  std::vector<PlainPoint> plain;   ///< of the others
};

/// The texture that a viewer multiplies a lit colour with: that of the base colour, or of emission
/// where the material emits and is opaque. Null where there is none, or none that glTF's core takes
/// (PNG, JPEG).
const std::optional<TextureUse>& shown_texture(const Scene& scene, const Material& material);

ShownFaces shown_faces(const LightScene& light);

} // namespace meninas
