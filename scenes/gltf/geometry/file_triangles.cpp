#include "scenes/gltf/geometry/file_triangles.h"

#include "scenes/gltf/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

std::vector<Vec3> decode_positions(const PrimitivePlace& at, std::size_t accessor) {
  const auto decoded = decode_vectors(at.document, accessor, 3);
  std::vector<Vec3> positions(decoded.size());
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto* p = &decoded.values[3 * k];
    positions[k] = {p[0], p[1], p[2]};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      at.fail(fmt::format("POSITION {} (of {}) is not finite", k,
                          place(at.document.root, "accessors", accessor)));
  }
  return positions;
}

std::vector<std::uint32_t> decode_corners(const PrimitivePlace& at, std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  const auto accessor = index_at(at.json, "indices");
  if (!accessor) {
    corners.resize(vertices);
    for (std::size_t k = 0; k < vertices; ++k)
      corners[k] = static_cast<std::uint32_t>(k);
    return corners;
  }
  corners = decode_indices(at.document, *accessor);
  const auto outside =
      std::ranges::find_if(corners, [&](std::uint32_t corner) { return corner >= vertices; });
  if (outside != corners.end())
    at.fail(fmt::format("index {} ({} of {}) is out of range: there are {} vertices", *outside,
                        outside - corners.begin(), place(at.document.root, "accessors", *accessor),
                        vertices));
  return corners;
}

std::vector<Corners> triangulate(Mode mode, std::span<const std::uint32_t> corners) {
  std::vector<Corners> triangles(triangles_in(mode, corners.size()));
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    if (mode == Mode::triangles)
      triangles[k] = {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]};
    else if (mode == Mode::strip)
      triangles[k] = {corners[k], corners[k + 1 + k % 2], corners[k + 2 - k % 2]};
    else
      triangles[k] = {corners[k + 1], corners[k + 2], corners[0]};
  }
  return triangles;
}

bool is_mirrored(const glm::dmat4& world) {
  const glm::dmat3 linear(world);
  double largest = 0.0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      largest = std::max(largest, std::abs(linear[column][row]));
  return largest > 0.0 && glm::determinant(linear / largest) < 0.0;
}

} // namespace meninas::gltf
