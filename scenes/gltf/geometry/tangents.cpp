#include "scenes/gltf/geometry/tangents.h"

#include "scenes/gltf/accessors.h"

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

Tangents decode_tangents(const PrimitivePlace& at) {
  const auto accessor = index_at(at.json["attributes"], "TANGENT");
  if (!accessor)
    return {};
  const auto decoded = decode_vectors(at.document, *accessor, 4);
  Tangents tangents;
  for (std::size_t k = 0; k < decoded.size(); ++k) {
    const auto* t = &decoded.values[4 * k];
    tangents.directions.emplace_back(t[0], t[1], t[2]);
    tangents.signs.push_back(t[3]);
  }
  return tangents;
}

/// T turned with the image; w has no say in its length.
static void turn(Vec3& direction, double& sign, const Vec3& normal, const TextureUse& map) {
  const double u = std::cos(map.rotation) * map.scale.y, v = std::sin(map.rotation) * map.scale.x;
  const double mirrored = map.scale.x * map.scale.y < 0.0 ? -1.0 : 1.0;
  const Vec3 across = sign * glm::cross(normal, direction);
  direction = mirrored * (u * direction - v * across);
  sign *= mirrored;
}

Tangents usable_tangents(const PrimitivePlace& at, Tangents tangents, std::span<const Vec3> normals,
                         const TextureUse& map, Findings& findings) {
  constexpr double along_normal = 0.02; // a sine; nearer to it rounding decides
  if (tangents.directions.empty())
    return {};
  if (normals.empty()) {
    findings.about("tangents without normals are left out, as glTF asks, in nodes", at.in.node);
    return {};
  }
  bool any = false;
  for (std::size_t k = 0; k < tangents.directions.size(); ++k) {
    Vec3& t = tangents.directions[k];
    double& w = tangents.signs[k];
    const Vec3 n = glm::normalize(normals[k]);
    const double length = glm::length(t);
    const Vec3 across = (t - glm::dot(n, t) * n) / length;
    // False, too, of what is no number.
    const bool is_direction = length > 1e-6 && std::isfinite(length) && std::abs(w) > 0.5 &&
                              std::isfinite(w) && glm::length(across) > along_normal;
    if (is_direction) {
      t = across;
      w = w < 0.0 ? -1.0 : 1.0;
      turn(t, w, n, map);
    } else {
      findings.about("tangents that are no directions across their normals are left out in nodes",
                     at.in.node);
    }
    // A scale of zero has left nothing.
    const double turned = is_direction ? glm::length(t) : 0.0;
    const bool is_used = turned > 0.0 && std::isfinite(turned);
    t = is_used ? t / turned : Vec3(0.0);
    w = is_used ? w : 0.0;
    any = any || is_used;
  }
  return any ? std::move(tangents) : Tangents{};
}

void move_tangent(const glm::dmat4& matrix, Vec3& direction, double& sign) {
  const glm::dmat3 linear(matrix);
  double largest = 0.0;
  for (int column = 0; column < 3; ++column)
    largest = std::max(largest, glm::length(linear[column]));
  const Vec3 moved = largest > 0.0 ? (linear / largest) * direction : Vec3(0.0);
  const double length = glm::length(moved);
  direction = length > 0.0 ? moved / length : Vec3(0.0);
  if (largest > 0.0 && glm::determinant(linear / largest) < 0.0)
    sign = -sign;
}

} // namespace meninas::gltf
