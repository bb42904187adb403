#include "scenes/gltf/geometry/instances.h"

#include "scenes/gltf/accessors.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

static const Json* attributes_of(const Document& document, std::size_t node) {
  return find(element(document.root, "nodes", node),
              {"extensions", "EXT_mesh_gpu_instancing", "attributes"});
}

static std::string where_of(const Document& document, std::size_t node) {
  return fmt::format("{}, EXT_mesh_gpu_instancing", place(document.root, "nodes", node));
}

std::uint64_t instance_count(const Document& document, std::size_t node) {
  const auto* attributes = attributes_of(document, node);
  if (!attributes)
    return 1;
  std::optional<std::uint64_t> count;
  for (const auto& [name, accessor] : attributes->items()) {
    const auto own = accessor_count(document, size_value(accessor));
    if (count && *count != own)
      throw InputError(
          document.file, where_of(document, node),
          fmt::format("{} has {} elements, another attribute has {}", one_line(name), own, *count));
    count = own;
  }
  return count.value_or(0);
}

/// Vectors of one attribute; empty when it is absent.
static Vectors decode(const Document& document, std::size_t node, std::string_view name,
                      std::size_t width) {
  const auto accessor = index_at(*attributes_of(document, node), name);
  if (!accessor)
    return {width, {}};
  auto vectors = decode_vectors(document, *accessor, width);
  if (!std::ranges::all_of(vectors.values, [](double x) { return std::isfinite(x); }))
    throw InputError(document.file, where_of(document, node),
                     fmt::format("{} is not finite", name));
  return vectors;
}

static Vec3 vec3_at(const Vectors& vectors, std::size_t k, double otherwise) {
  if (vectors.values.empty())
    return Vec3(otherwise);
  const auto* v = &vectors.values[3 * k];
  return {v[0], v[1], v[2]};
}

static glm::dmat4 rotation_at(const Vectors& rotations, std::size_t k) {
  if (rotations.values.empty())
    return glm::dmat4(1.0);
  const auto* v = &rotations.values[4 * k];
  const auto largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2]), std::abs(v[3])});
  if (largest == 0.0)
    return glm::dmat4(1.0);
  return glm::mat4_cast(
      glm::normalize(glm::dquat(v[3] / largest, v[0] / largest, v[1] / largest, v[2] / largest)));
}

std::vector<glm::dmat4> instance_matrices(const Document& document, const PlacedNode& node) {
  if (!attributes_of(document, node.index))
    return {node.world};
  const auto count = instance_count(document, node.index);
  const auto translations = decode(document, node.index, "TRANSLATION", 3);
  const auto rotations = decode(document, node.index, "ROTATION", 4);
  const auto scales = decode(document, node.index, "SCALE", 3);
  std::vector<glm::dmat4> matrices;
  for (std::size_t k = 0; k < count; ++k)
    matrices.push_back(node.world * glm::translate(glm::dmat4(1.0), vec3_at(translations, k, 0.0)) *
                       rotation_at(rotations, k) *
                       glm::scale(glm::dmat4(1.0), vec3_at(scales, k, 1.0)));
  return matrices;
}

} // namespace meninas::gltf
