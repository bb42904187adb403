// Substructuring (Cohen, Greenberg, Immel, Brock 1986): light is sent and received by parts of surfaces that are
// larger than the elements below them. The parts make a tree of nodes over the elements, of any depth
// (Hanrahan, Salzman, Aupperle 1991); hierarchical/node_cut.h chooses those that are solved, and at the vertices of the
// elements light is gathered from them (field/final_gathering.h).
//
// At the top is one node for each side, at the bottom the elements.
// Above sides that are small faces of something larger are nodes for clusters of them (face_clusters.h).
// A grid of root cells is halved, in the direction in which it is longer or in both;
// below, a node is a cell of the forest (element_mesh.h); the regions of a cut leaf are its children.
// A grid of triangles with n rows
// is a parallelogram of (n - k) x k pairs and two such grids, of n - k and of k rows, k = n / 2.
// A node is a part of its patch's (u, v): it covers  uv + (s, t) extent,  triangles s + t <= 1.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"

#include <vector>

namespace meninas {

enum class TreeNodeId : std::uint32_t {};

struct TreeNode {
  TreeNodeId parent = none<TreeNodeId>;
  TreeNodeId first_child = none<TreeNodeId>; ///< none: a leaf
  std::uint32_t child_count = 0;             ///< in a row
  bool triangle = false;
  bool cut = false; ///< something stands across it: its parts have light of their own
  SideId side = none<SideId>; ///< none: a cluster of faces, which are its children
  ElementId element = none<ElementId>; ///< of a leaf
  Vec2 uv{0.0}, extent{1.0};
  std::uint32_t first_leaf = 0, leaf_count = 0; ///< in NodeTree::elements
};

struct NodeTree {
  std::vector<TreeNode>
      nodes; ///< level by level: every node after its parent; clusters, their sides, then the other sides in their order
  std::vector<ElementId> elements; ///< those below a node follow one another
};

NodeTree make_node_tree(const LightScene& light);

inline bool is_leaf(const TreeNode& node) { return node.child_count == 0; }
inline bool is_cluster(const TreeNode& node) { return node.side == none<SideId>; }

inline std::span<const ElementId> elements_below(const NodeTree& tree, TreeNodeId node) {
  const TreeNode& n = tree.nodes[index(node)];
  return std::span(tree.elements).subspan(n.first_leaf, n.leaf_count);
}

/// The node as an area to spread rays over; a leaf is its element to the last bit, a cluster all of its faces.
ReceiverArea area_of(const LightScene& light, const NodeTree& tree, TreeNodeId node);

/// The nodes, in the order of the tree, with the faces of clusters in place of these.
std::vector<TreeNodeId> with_faces_of_clusters(const NodeTree& tree, std::span<const TreeNodeId> nodes);

} // namespace meninas
