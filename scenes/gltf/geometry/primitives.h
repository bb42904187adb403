// The primitives of the meshes that nodes show,
// and what they need, known before any of them is decoded.
#pragma once

#include "scenes/gltf/stages.h"

namespace meninas::gltf {

enum class Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

/// What the primitives of one node's mesh have in common.
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

std::size_t triangles_in(Mode mode, std::uint64_t corners);

/// Throws OutputError when the geometry would take more than the limit of memory, or has more
/// primitives than any scene: instances multiply, so a small file can ask for any amount of either.
void check_geometry_size(const Document& document, std::span<const PlacedNode> nodes);

} // namespace meninas::gltf
