// Files made by code and compressed by the encoders of the libraries that the loader decodes with.
#pragma once

#include "tests/scenes/gltf/gltf_file.h"

#include <array>
#include <cstdint>

namespace meninas::test {

/// A bumpy sheet of 2 n^2 triangles as one primitive: POSITION, NORMAL, TEXCOORD_0, COLOR_0 (bytes).
GltfFile bumpy_sheet(std::uint32_t n = 9);
/// The same with positions of 16 bits and the node that scales them, as optimisers write them.
GltfFile quantised_sheet(std::uint32_t n = 9);

/// The values of an accessor of a plain file, one after the other.
Bytes accessor_bytes(const GltfFile& file, std::size_t accessor);

/// Position, texture coordinates and colour of each corner of a triangle.
using Corners = std::array<std::array<double, 9>, 3>;
/// All triangles, in an order that depends neither on that of the file's vertices and triangles
/// nor on which corner is the first.
std::vector<Corners> triangle_corners(const Scene& scene);

// --- meshopt

Bytes encode_vertices(const void* data, std::size_t count, std::size_t stride);
Bytes encode_triangles(const std::vector<std::uint32_t>& indices);
Bytes encode_sequence(const std::vector<std::uint32_t>& indices);

/// The file with every view of its primitives compressed: triangles, other indices and attributes.
/// The decoded views lie in buffers[1], which has no data.
GltfFile with_meshopt(const GltfFile& plain, const std::string& name = "EXT_meshopt_compression");

// --- Draco

struct DracoChoice {
  int position_bits = 0; ///< 0: not quantised
  int normal_bits = 0;
  bool edgebreaker = true; ///< else sequential, which keeps the order of vertices
};

/// The primitive's attributes and faces.
Bytes encode_draco(const GltfFile& plain, const Json& primitive, const DracoChoice& choice);

/// The file with every primitive compressed; there is no other data.
/// Draco's numbers of attributes are their places in the alphabet.
GltfFile with_draco(const GltfFile& plain, const DracoChoice& choice = {});

} // namespace meninas::test
