#include "scenes/gltf/geometry/normals.h"

#include "scenes/gltf/accessors.h"

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

Normals decode_normals(const PrimitivePlace& at, Findings& findings) {
  const auto accessor = index_at(at.json["attributes"], "NORMAL");
  if (!accessor)
    return {};
  const auto decoded = decode_vectors(at.document, *accessor, 3);
  // Half a step along each of two axes across the normal.
  Normals normals{{}, std::sqrt(0.5) * step_of_values(at.document, *accessor)};
  normals.values.reserve(decoded.size());
  for (std::size_t k = 0; k < decoded.size(); ++k) {
    const auto* n = &decoded.values[3 * k];
    const double length = glm::length(Vec3(n[0], n[1], n[2]));
    const bool is_direction = std::isfinite(length) && length > 1e-6;
    if (!is_direction)
      findings.about("normals that are no directions are left out in nodes", at.in.node);
    normals.values.push_back(is_direction ? Vec3(n[0], n[1], n[2]) : Vec3(0.0));
  }
  return normals;
}

Vec3 moved_normal(const glm::dmat4& matrix, const Vec3& normal) {
  const glm::dmat3 linear(matrix);
  double largest = 0.0;
  for (int column = 0; column < 3; ++column)
    largest = std::max(largest, glm::length(linear[column]));
  if (!(largest > 0.0) || normal == Vec3(0.0))
    return Vec3(0.0);
  const glm::dmat3 scaled = linear / largest;
  const Vec3 x = glm::cross(scaled[1], scaled[2]), y = glm::cross(scaled[2], scaled[0]),
             z = glm::cross(scaled[0], scaled[1]);
  const Vec3 moved = normal.x * x + normal.y * y + normal.z * z;
  const double length = glm::length(moved);
  if (!(length > 0.0))
    return Vec3(0.0);
  return (glm::dot(scaled[0], x) < 0.0 ? -1.0 : 1.0) / length * moved;
}

} // namespace meninas::gltf
