// The tree of a file's nodes, by name: a scene is flat, but people ask for groups.
//
// Modellers and exporters put the parts of a thing below a node without a mesh,
// and the name of the thing is that node's. Here it stands for all that is below it.
#pragma once

#include "scenes/gltf/gltf.h"

#include <span>

namespace meninas {

struct FileNode {
  std::string name; ///< as in the file, `node12` where it has none
  std::size_t parent = 0; ///< its place in the tree; its own for a root
  NodeId node = none<NodeId>; ///< that of the scene which load_gltf gives; none without a mesh
};

/// The nodes of the chosen scene, parents before children.
std::vector<FileNode> read_node_tree(const std::filesystem::path& file,
                                     const GltfSettings& settings = {});

/// The nodes that a name stands for.
struct NamedNodes {
  std::vector<NodeId> nodes;
  std::size_t below = 0; ///< how many nodes with meshes are below a node with a mesh, left out
};

/// The scene's nodes of that name, each for itself alone; if there are none,
/// all nodes with meshes that are below a node of that name.
/// Throws UsageError, with the nearest known name as a hint, when there is no such node,
/// or nothing with a mesh below it.
NamedNodes nodes_called(const Scene& scene, std::span<const FileNode> tree,
                        const std::string& name);

} // namespace meninas
