#include "scenes/gltf/tree.h"

#include "scenes/gltf/stages.h"
#include "scenes/gltf/state/visibility.h"
#include "scenes/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

using namespace gltf;

namespace {

std::string name_in_file(const Json& root, std::size_t node) {
  auto name = name_of(element(root, "nodes", node));
  return name.empty() ? fmt::format("node{}", node) : name;
}

/// Whether a node of that name is above, by place in the tree. Parents stand before children.
std::vector<std::uint8_t> marked_below(std::span<const FileNode> tree, const std::string& name) {
  std::vector<std::uint8_t> below(tree.size(), 0);
  for (std::size_t k = 0; k < tree.size(); ++k) {
    const std::size_t parent = tree[k].parent;
    if (parent != k && (below[parent] != 0 || tree[parent].name == name))
      below[k] = 1;
  }
  return below;
}

/// The names of what can be asked for: nodes with meshes and groups of such.
std::vector<std::string> known_names(const Scene& scene, std::span<const FileNode> tree) {
  std::vector<std::string> names;
  for (const Node& node : scene.nodes)
    names.push_back(node.name);
  std::vector<std::uint8_t> holds(tree.size(), 0);
  for (std::size_t k = tree.size(); k-- > 0;) {
    if (tree[k].node != none<NodeId>)
      holds[k] = 1;
    holds[tree[k].parent] |= holds[k];
  }
  for (std::size_t k = 0; k < tree.size(); ++k)
    if (holds[k] != 0 && tree[k].node == none<NodeId>)
      names.push_back(tree[k].name);
  return names;
}

} // namespace

std::vector<FileNode> read_node_tree(const std::filesystem::path& file,
                                     const GltfSettings& settings) {
  auto content = read_whole_file(file, settings.memory_limit);
  if (!content.problem.empty())
    throw UserError(content.kind, file.string(), "", content.problem);
  Document document{.file = file.string(), .folder = {}, .settings = settings, .root = {}, .buffers = {}};
  document.root =
      parse_container(document.file, std::move(content.bytes), settings.memory_limit).root;
  check_structure(document.file, document.root);

  Findings findings; // said when the scene was read
  hide_nodes(document.root, findings);
  const auto placed = place_nodes(document, findings);
  std::vector<std::size_t> place_of(count_of(document.root, "nodes"), placed.size());
  for (std::size_t k = 0; k < placed.size(); ++k)
    place_of[placed[k].index] = k;
  std::vector<FileNode> tree(placed.size());
  std::uint32_t meshes = 0;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const auto& json = element(document.root, "nodes", placed[k].index);
    tree[k].name = name_in_file(document.root, placed[k].index);
    tree[k].parent = k;
    if (index_at(json, "mesh"))
      tree[k].node = static_cast<NodeId>(meshes++);
  }
  for (std::size_t k = 0; k < placed.size(); ++k)
    if (const auto* children = find(element(document.root, "nodes", placed[k].index), "children"))
      for (const auto& child : *children)
        if (const auto at = place_of[size_value(child)]; at < placed.size() && at > k)
          tree[at].parent = k;
  return tree;
}

NamedNodes nodes_called(const Scene& scene, std::span<const FileNode> tree,
                        const std::string& name) {
  NamedNodes found;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n)
    if (scene.nodes[n].name == name)
      found.nodes.push_back(NodeId{n});
  const auto below = marked_below(tree, name);
  std::vector<NodeId> inside;
  for (std::size_t k = 0; k < tree.size(); ++k)
    if (below[k] != 0 && tree[k].node != none<NodeId>)
      inside.push_back(tree[k].node);
  if (!found.nodes.empty()) {
    found.below = inside.size();
    return found;
  }
  if (!inside.empty() && index(inside.back()) >= scene.nodes.size())
    throw InputError(scene.file, "", "has changed while it was read");
  found.nodes = std::move(inside);
  if (!found.nodes.empty())
    return found;

  const bool is_there = std::ranges::find(tree, name, &FileNode::name) != tree.end();
  if (is_there)
    throw UsageError(scene.file, fmt::format("node '{}' has no mesh, nor has any below it", name));
  throw UsageError(scene.file, unknown_name("node", name, known_names(scene, tree)));
}

} // namespace meninas
