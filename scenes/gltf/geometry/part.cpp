#include "scenes/gltf/geometry/part.h"

#include "scenes/gltf/geometry/mikktspace.h"
#include "scenes/materials/normal_map.h"
#include "scenes/materials/texture_lookup.h"

#include <cmath>
#include <limits>

namespace meninas::gltf {

namespace {

constexpr std::uint32_t no_corner = std::numeric_limits<std::uint32_t>::max();

template <typename T>
void append_copy(std::vector<T>& values, std::uint32_t k) {
  if (values.empty())
    return;
  const T value = values[k];
  values.push_back(value);
}

/// Finds for each corner a vertex that has its tangent.
class Division {
public:
  explicit Division(Part& part)
      : part_(part), tangents_(part.positions.size(), glm::vec4(0.0F)),
        next_(part.positions.size(), no_corner) {}

  void give(std::uint32_t& corner, const glm::vec4& tangent) {
    while (tangents_[corner] != glm::vec4(0.0F) && tangents_[corner] != tangent) {
      if (next_[corner] == no_corner) {
        next_[corner] = static_cast<std::uint32_t>(tangents_.size());
        divide(corner);
      }
      corner = next_[corner];
    }
    tangents_[corner] = tangent;
  }

  const std::vector<glm::vec4>& tangents() const { return tangents_; }

private:
  void divide(std::uint32_t vertex) {
    append_copy(part_.positions, vertex);
    append_copy(part_.attributes, vertex);
    append_copy(part_.normals.values, vertex);
    tangents_.emplace_back(0.0F);
    next_.push_back(no_corner);
  }

  Part& part_;
  std::vector<glm::vec4> tangents_;
  std::vector<std::uint32_t> next_; ///< the vertex that was made of this one
};

} // namespace

/// Of a corner's normal, or that of its face; zero where that is none.
static glm::vec4 level_tangent_at(const Part& part, const Corners& corners, std::size_t k) {
  const auto& p = part.positions;
  Vec3 normal = part.normals.values.empty() ? Vec3(0.0) : part.normals.values[corners[k]];
  if (!(glm::length(normal) > 0.0))
    normal = glm::cross(p[corners[1]] - p[corners[0]], p[corners[2]] - p[corners[0]]);
  const double length = glm::length(normal);
  return length > 0.0 && std::isfinite(length) ? glm::vec4(level_tangent(normal / length), 1.0F)
                                               : glm::vec4(0.0F);
}

bool settle_tangents(Part& part) {
  if (!part.tangent_map || !part.tangents.directions.empty())
    return false;
  std::vector<Vec2> texcoords;
  const auto set = static_cast<std::size_t>(part.tangent_map->texcoord_set);
  texcoords.reserve(part.attributes.size());
  for (const VertexAttributes& told : part.attributes)
    texcoords.push_back(transformed_texcoord(*part.tangent_map, Vec2(told.texcoord[set])));
  auto made = mikktspace_tangents({part.positions, part.normals.values, texcoords, part.triangles});
  bool level = false;
  for (std::size_t t = 0; part.anisotropic && t < made.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (made[t][k] == glm::vec4(0.0F)) {
        made[t][k] = level_tangent_at(part, part.triangles[t], k);
        level = true;
      }
  Division division(part);
  for (std::size_t t = 0; t < made.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (made[t][k] != glm::vec4(0.0F))
        division.give(part.triangles[t][k], made[t][k]);
  for (const glm::vec4& tangent : division.tangents()) {
    part.tangents.directions.emplace_back(tangent);
    part.tangents.signs.push_back(double{tangent.w});
  }
  return level;
}

} // namespace meninas::gltf
