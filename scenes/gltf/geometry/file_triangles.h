// The triangles of a primitive as they stand in the file: positions in the coordinates of its mesh, metres.
#pragma once

#include "scenes/gltf/geometry/primitives.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <vector>

namespace meninas::gltf {

using Corners = std::array<std::uint32_t, 3>; ///< of a triangle, by vertex of its part

/// Throws InputError unless all are finite.
std::vector<Vec3> decode_positions(const PrimitivePlace& at, std::size_t accessor);

/// The vertices in the order in which triangles take them; throws InputError for one that is not there.
std::vector<std::uint32_t> decode_corners(const PrimitivePlace& at, std::size_t vertices);

/// glTF 2.0, 3.7.2.1:
/// every second triangle of a strip is turned round, so that all face the same way.
std::vector<Corners> triangulate(Mode mode, std::span<const std::uint32_t> corners);

/// A mirrored node shows its triangles turned round,
/// unless they are turned round once more (glTF 2.0, 3.7.4).
bool is_mirrored(const glm::dmat4& world);

} // namespace meninas::gltf
