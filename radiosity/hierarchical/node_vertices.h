// Which vertices gather indirect light, and what those between take from them, where nodes stand for many elements.
//
// The corners of receivers gather; inside a receiver the light is smooth, and a vertex takes the bilinear mean of the corners, linear in
// triangles. A vertex on the border of a large and a small receiver takes from the small one, or is a corner of it: every vertex has one value,
// so that there is no crack.
#pragma once

#include "radiosity/hierarchical/node_tree.h"

namespace meninas {

/// By ElementVertexId. A vertex that gathers takes all of its own value.
struct VertexShares {
  std::vector<std::array<ElementVertexId, 4>> from;
  std::vector<std::array<float, 4>> weight; ///< sum 1
  std::vector<std::uint8_t> between; ///< takes only from those that gather, and others take from it
};

/// Whether a vertex takes from itself alone.
inline bool gathers(const VertexShares& shares, std::size_t vertex) {
  return index(shares.from[vertex][0]) == vertex;
}

/// A vertex within a node, and what it would take from the node's corners.
struct NodeProbe {
  ElementVertexId vertex;
  std::array<float, 4> weight; ///< of the corners
};

/// The corners of a node; a triangle repeats its third.
ElementCorners corners_of(const ElementMesh& mesh, const TreeNode& node);

/// Those corners of a node's parts that are nearest to its middle: one, or two where it has two parts. None of an element.
std::vector<NodeProbe> probes_of(const ElementMesh& mesh, const NodeTree& tree,
                                 const TreeNode& node);

/// By ElementVertexId, 1 where the nodes need indirect light: at corners and in the middle.
std::vector<std::uint8_t> wanted_vertices(const ElementMesh& mesh, const NodeTree& tree,
                                          std::span<const TreeNodeId> nodes);

/// Of a cut through the tree: no receiver is above another.
VertexShares vertex_shares(const ElementMesh& mesh, const NodeTree& tree,
                           std::span<const TreeNodeId> receivers);

} // namespace meninas
