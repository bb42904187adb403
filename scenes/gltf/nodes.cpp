// The chosen scene's nodes and their world matrices, from graphs that may be no trees.
#include "scenes/gltf/stages.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace meninas::gltf {

static bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row]))
        return false;
  return true;
}

static glm::dmat4 rotation_of(const Document& document, std::size_t node, const Json& json,
                              Findings& findings) {
  const auto numbers = numbers_at(json, "rotation");
  if (numbers.empty())
    return glm::dmat4(1.0);
  const auto largest = std::max(
      std::abs(*std::ranges::max_element(numbers, {}, [](double x) { return std::abs(x); })), 0.0);
  if (largest == 0.0)
    throw InputError(document.file, place(document.root, "nodes", node), "'rotation' is zero");
  glm::dquat q(numbers[3] / largest, numbers[0] / largest, numbers[1] / largest,
               numbers[2] / largest);
  const auto length = glm::length(q);
  // Floats in the file are off by 1e-7, sloppy exporters by more;
  // either way the direction is what is meant.
  if (std::abs(length * largest - 1.0) > 1e-3)
    findings.about("rotations that are no unit quaternions were normalised",
                   place(document.root, "nodes", node));
  return glm::mat4_cast(q / length);
}

static glm::dmat4 local_matrix(const Document& document, std::size_t node, Findings& findings) {
  const auto& json = element(document.root, "nodes", node);
  const auto numbers = numbers_at(json, "matrix");
  if (numbers.empty()) {
    const auto translation =
        glm::translate(glm::dmat4(1.0), vec3_or(json, "translation", Vec3(0.0)));
    const auto scale = glm::scale(glm::dmat4(1.0), vec3_or(json, "scale", Vec3(1.0)));
    return translation * rotation_of(document, node, json, findings) * scale;
  }
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      matrix[column][row] = numbers[4 * column + row];
  const glm::dvec4 last(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
  if (glm::any(glm::greaterThan(glm::abs(last - glm::dvec4(0.0, 0.0, 0.0, 1.0)), glm::dvec4(1e-6))))
    throw InputError(document.file, place(document.root, "nodes", node),
                     "'matrix' is not affine: its last row is not 0 0 0 1");
  for (int column = 0; column < 4; ++column)
    matrix[column][3] = column == 3 ? 1.0 : 0.0;
  if (json.contains("translation") || json.contains("rotation") || json.contains("scale"))
    findings.about(
        "nodes with both a matrix and translation, rotation or scale: the matrix is used",
        place(document.root, "nodes", node));
  return matrix;
}

static std::vector<std::size_t> children_of(const Json& root, std::size_t node) {
  std::vector<std::size_t> children;
  if (const auto* list = find(element(root, "nodes", node), "children"))
    for (const auto& child : *list)
      children.push_back(size_value(child));
  return children;
}

/// The parent of every node, or of none.
/// Refuses nodes with two parents and cycles, so that what is left is a forest.
static std::vector<std::size_t> parents_of(const Document& document) {
  const auto count = count_of(document.root, "nodes");
  std::vector<std::size_t> parents(count, count);
  for (std::size_t node = 0; node < count; ++node) {
    for (const auto child : children_of(document.root, node)) {
      if (child == node || parents[child] != count)
        throw InputError(document.file, place(document.root, "nodes", child),
                         child == node ? "node cycle: it is its own child"
                                       : fmt::format("has two parents, nodes[{}] and nodes[{}]",
                                                     parents[child], node));
      parents[child] = node;
    }
  }
  // Where every node has at most one parent,
  // a walk upwards that meets itself is the only kind of cycle.
  std::vector<std::size_t> walk_of(count, count);
  for (std::size_t start = 0; start < count; ++start) {
    auto at = start;
    for (; at != count && walk_of[at] == count; at = parents[at])
      walk_of[at] = start;
    if (at != count && walk_of[at] == start)
      throw InputError(document.file, place(document.root, "nodes", at),
                       "node cycle: it is its own ancestor");
  }
  return parents;
}

static std::optional<std::size_t> chosen_scene(const Document& document) {
  const auto count = count_of(document.root, "scenes");
  const auto& asked = document.settings.scene;
  if (!asked) {
    if (count == 0)
      return std::nullopt;
    return index_at(document.root, "scene").value_or(0);
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) {
    const auto name = name_of(element(document.root, "scenes", k));
    if (name == *asked)
      return k;
    names.push_back(name.empty() ? std::to_string(k) : name);
  }
  for (std::size_t k = 0; k < count; ++k)
    if (std::to_string(k) == *asked)
      return k;
  throw UsageError(fmt::format("scene '{}'", *asked),
                   count == 0 ? "the file has no scenes"
                              : fmt::format("the file has {}", name_list(names, count)));
}

/// Which nodes are below a listed one. Every node is walked through once.
static std::vector<bool> below_listed(const Json& root, const std::vector<bool>& listed) {
  std::vector<bool> below(listed.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t node = 0; node < listed.size(); ++node)
    if (listed[node])
      open.push_back(node);
  while (!open.empty()) {
    const auto node = open.back();
    open.pop_back();
    for (const auto child : children_of(root, node)) {
      if (!below[child])
        open.push_back(child);
      below[child] = true;
    }
  }
  return below;
}

/// Where the walk through the chosen scene begins. A scene lists roots alone;
/// exporters also list nodes below them, which stay where their parents put them
/// and are shown once, and nodes of which no ancestor is listed, which become roots.
static std::vector<std::size_t>
root_nodes(const Document& document, std::span<const std::size_t> parents, Findings& findings) {
  const auto none = parents.size();
  std::vector<std::size_t> roots;
  const auto scene = chosen_scene(document);
  if (!scene) {
    for (std::size_t node = 0; node < none; ++node)
      if (parents[node] == none)
        roots.push_back(node);
    return roots;
  }
  const auto* list = find(element(document.root, "scenes", *scene), "nodes");
  if (!list)
    return roots;
  std::vector<bool> listed(none, false);
  for (const auto& value : *list)
    listed[size_value(value)] = true;
  const auto below = below_listed(document.root, listed);
  std::vector<bool> told(none, false);
  for (const auto& value : *list) {
    const auto node = size_value(value);
    const auto where = place(document.root, "nodes", node);
    if (told[node])
      findings.about("the scene lists nodes twice, which are shown once", where);
    else if (below[node])
      findings.about("the scene lists nodes that are also children of others, which are shown once",
                     where);
    else
      roots.push_back(node);
    if (!below[node] && !told[node] && parents[node] != none)
      findings.about("the scene begins at nodes whose parents, left out, do not move them", where);
    told[node] = true;
  }
  return roots;
}

std::vector<PlacedNode> place_nodes(const Document& document, Findings& findings) {
  const auto parents = parents_of(document);
  std::vector<PlacedNode> placed;
  std::vector<PlacedNode> open;
  const auto push = [&](const std::vector<std::size_t>& nodes, const glm::dmat4& world) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
      open.push_back({*node, world});
  };
  push(root_nodes(document, parents, findings), glm::dmat4(1.0));
  while (!open.empty()) {
    auto node = open.back();
    open.pop_back();
    node.world = node.world * local_matrix(document, node.index, findings);
    if (!is_finite(node.world))
      throw InputError(document.file, place(document.root, "nodes", node.index),
                       "its transform is not finite");
    placed.push_back(node);
    push(children_of(document.root, node.index), node.world);
  }
  return placed;
}

std::string lamp_of_node(const Document& document, std::size_t node) {
  const auto* extras = find(element(document.root, "nodes", node), "extras");
  if (!extras || !extras->is_object())
    return {};
  const auto* lamp = find(*extras, "lamp");
  return lamp && lamp->is_string() ? lamp->get<std::string>() : std::string{};
}

std::vector<std::string> unique_names(const std::vector<std::string>& names) {
  // A name that the file gives is kept by the first who has it, before any suffix is made up.
  std::set<std::string> taken(names.begin(), names.end());
  std::set<std::string> given;
  std::map<std::string, std::size_t> next;
  std::vector<std::string> unique;
  for (const auto& name : names) {
    auto candidate = name;
    if (!given.insert(name).second) {
      auto& suffix = next[name];
      do
        candidate = fmt::format("{}.{}", name, ++suffix);
      while (!taken.insert(candidate).second);
    }
    unique.push_back(candidate);
  }
  return unique;
}

} // namespace meninas::gltf
