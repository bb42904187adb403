#include "scenes/gltf/geometry/deformation.h"

#include "scenes/gltf/accessors.h"
#include "scenes/gltf/geometry/normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

static Vectors decode_for_each(const Document& document, const std::string& where,
                               std::string_view attribute, std::size_t accessor, std::size_t width,
                               std::size_t count) {
  auto decoded = decode_vectors(document, accessor, width);
  if (decoded.size() != count)
    throw InputError(document.file, where,
                     fmt::format("{} has {} elements, POSITION has {}",
                                 one_line(std::string(attribute)), decoded.size(), count));
  if (!std::ranges::all_of(decoded.values, [](double x) { return std::isfinite(x); }))
    throw InputError(document.file, where,
                     fmt::format("{} is not finite", one_line(std::string(attribute))));
  return decoded;
}

void apply_morph_targets(const Morph& morph, std::string_view attribute,
                         std::vector<Vec3>& values) {
  const auto* targets = find(morph.primitive, "targets");
  if (!targets || values.empty())
    return;
  for (std::size_t k = 0; k < std::min(targets->size(), morph.weights.size()); ++k) {
    const auto accessor = index_at((*targets)[k], attribute);
    if (morph.weights[k] == 0.0 || !accessor)
      continue;
    const auto displacement = decode_for_each(
        morph.document, morph.where, fmt::format("target {}", k), *accessor, 3, values.size());
    for (std::size_t v = 0; v < values.size(); ++v) {
      const auto* d = &displacement.values[3 * v];
      values[v] += morph.weights[k] * Vec3(d[0], d[1], d[2]);
    }
  }
}

static glm::dmat4 matrix_of(const double* numbers) {
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      matrix[column][row] = row < 3 ? numbers[4 * column + row] : (column == 3 ? 1.0 : 0.0);
  return matrix;
}

static std::vector<glm::dmat4> joint_matrices(const Document& document, std::size_t skin,
                                              std::span<const PlacedNode* const> placed) {
  const auto& json = element(document.root, "skins", skin);
  std::vector<glm::dmat4> matrices;
  for (const auto& joint : json["joints"]) {
    const auto* node = placed[size_value(joint)];
    if (!node)
      return {};
    matrices.push_back(node->world);
  }
  const auto inverse = index_at(json, "inverseBindMatrices");
  if (!inverse)
    return matrices;
  const auto bind = decode_vectors(document, *inverse, 16);
  if (bind.size() < matrices.size())
    throw InputError(
        document.file, place(document.root, "skins", skin),
        fmt::format("{} inverse bind matrices for {} joints", bind.size(), matrices.size()));
  for (std::size_t k = 0; k < matrices.size(); ++k)
    matrices[k] = matrices[k] * matrix_of(&bind.values[16 * k]);
  return matrices;
}

Skins::Skins(const Document& document, std::span<const PlacedNode> nodes)
    : document_(document), placed_(count_of(document.root, "nodes"), nullptr) {
  for (const auto& node : nodes)
    placed_[node.index] = &node;
}

const std::vector<glm::dmat4>& Skins::joints(std::size_t skin) {
  const auto [found, is_new] = joints_.try_emplace(skin);
  if (is_new)
    found->second = joint_matrices(document_, skin, placed_);
  return found->second;
}

/// The weighted sum of the matrices of one vertex;
/// sums of weights that exporters rounded are made one.
static glm::dmat4 blend(const Document& document, const std::string& where,
                        std::span<const glm::dmat4> joints, std::span<const Vectors> indices,
                        std::span<const Vectors> weights, std::size_t vertex) {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (std::size_t set = 0; set < indices.size(); ++set) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto joint = static_cast<std::size_t>(indices[set].values[4 * vertex + k]);
      const auto weight = std::max(weights[set].values[4 * vertex + k], 0.0);
      if (weight == 0.0)
        continue;
      if (joint >= joints.size())
        throw InputError(
            document.file, where,
            fmt::format("vertex {} follows joint {} of {}", vertex, joint, joints.size()));
      sum += weight * joints[joint];
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : joints[0];
}

bool apply_skin(const Skinning& skinning, std::vector<Vec3>& positions, std::vector<Vec3>& normals,
                Tangents& tangents) {
  const auto& [document, where, primitive, joints] = skinning;
  const auto& attributes = primitive["attributes"];
  std::vector<Vectors> indices;
  std::vector<Vectors> weights;
  for (std::size_t set = 0;; ++set) {
    const auto joint_name = fmt::format("JOINTS_{}", set);
    const auto weight_name = fmt::format("WEIGHTS_{}", set);
    const auto joint = index_at(attributes, joint_name);
    const auto weight = index_at(attributes, weight_name);
    if (!joint || !weight)
      break;
    indices.push_back(decode_for_each(document, where, joint_name, *joint, 4, positions.size()));
    weights.push_back(decode_for_each(document, where, weight_name, *weight, 4, positions.size()));
  }
  if (indices.empty() || joints.empty())
    return false;
  for (const auto& set : indices)
    if (!std::ranges::all_of(set.values, [](double x) { return x >= 0.0; }))
      throw InputError(document.file, where, "a joint's number is negative");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::dmat4 matrix = blend(document, where, joints, indices, weights, v);
    positions[v] = Vec3(matrix * glm::dvec4(positions[v], 1.0));
    if (!normals.empty())
      normals[v] = moved_normal(matrix, normals[v]);
    if (!tangents.directions.empty())
      move_tangent(matrix, tangents.directions[v], tangents.signs[v]);
  }
  return true;
}

} // namespace meninas::gltf
