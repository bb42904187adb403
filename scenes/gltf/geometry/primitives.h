// The primitives of the meshes that nodes show,
// and what they need, known before any of them is decoded.
#pragma once

#include "scenes/gltf/stages.h"

namespace meninas::gltf {

enum class Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

/// The common data of the primitives of one node's mesh.
struct MeshPlace {
  const Document& document;
  std::size_t mesh = 0;
  std::string node; ///< its name, or `node12`
  std::vector<double> morph_weights;
};

/// meshes[0] 'Wall', primitive 2
std::string primitive_place(const Json& root, std::size_t mesh, std::size_t number);

/// A primitive and how to speak of it.
struct PrimitivePlace {
  const Document& document;
  const Json& json;
  const MeshPlace& in;
  std::size_t number = 0;

  std::string where() const;
  [[noreturn]] void fail(const std::string& what) const;
};

MeshPlace mesh_place(const Document& document, std::size_t node, std::size_t mesh);

template <typename Visit>
void each_primitive(const MeshPlace& place, Visit visit) {
  const auto& primitives = element(place.document.root, "meshes", place.mesh)["primitives"];
  for (std::size_t k = 0; k < primitives.size(); ++k)
    visit(PrimitivePlace{place.document, primitives[k], place, k});
}

Mode mode_of(const PrimitivePlace& at);

/// None for a primitive that nothing can be seen of: glTF 2.0, 3.7.2.1 lets positions be absent.
std::optional<std::size_t> position_accessor(const PrimitivePlace& at);

/// Whether its facets may have two widths (KHR_materials_anisotropy).
bool is_anisotropic(const PrimitivePlace& at);

/// The texture whose coordinates its tangents follow (materials/normal_map.h): the normal map of its
/// material, if it is read, or that of anisotropy, as it were without its transform. None where
/// nothing asks for tangents.
std::optional<TextureUse> tangent_map_of(const PrimitivePlace& at);

std::size_t triangles_in(Mode mode, std::uint64_t corners);

/// The size of the geometry of the scene.
struct GeometrySize {
  double bytes = 0.0, vertices = 0.0;
};

/// The size of vertices and triangles before any is made; a vertex whose corners have several tangents makes
/// more (part.h). Throws OutputError when there are more primitives than any scene has, or as
/// below: instances multiply, so a small file can ask for any amount of either.
GeometrySize geometry_size(const Document& document, std::span<const PlacedNode> nodes);

/// Throws OutputError when that is more than the limit of memory.
void check_size(const Document& document, const GeometrySize& size);

/// The size of the vertices of a part in so many copies.
GeometrySize size_of_vertices(double copies, double vertices);

} // namespace meninas::gltf
