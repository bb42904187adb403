// Which vertices gather indirect light,
// and what those between take from them, where nodes stand for many elements.
//
// The corners of a node gather, and a vertex in its middle, which tells whether light is straight
// between them (node_bends.h). Its parts share that vertex: what else they have for corners,
// if it does not gather as a corner of another node, lies between corners of this one.
// A node of two parts has two such vertices, on its long edges. Of light that bends from one to
// the other they tell nothing: a third, near its middle, is asked, and keeps no value of its own.
// A vertex within a part takes the bilinear mean of the part's corners, linear in triangles.
// One on the border of a large and a small part takes from the small one, or is a corner of it:
// every vertex has one value, so that there is no crack.
#pragma once

#include "radiosity/transport/element_hierarchy.h"

namespace meninas {

/// By ElementVertexId. A vertex that gathers takes all of its own value.
struct InterpolationWeights {
  std::vector<std::array<ElementVertexId, 4>> from;
  std::vector<std::array<float, 4>> weight; ///< sum 1
  std::vector<std::uint8_t> between; ///< 1: a corner of a part, between corners that gather; others take from it
};

/// Whether a vertex takes from itself alone.
inline bool gathers(const InterpolationWeights& shares, std::size_t vertex) {
  return index(shares.from[vertex][0]) == vertex;
}

/// A vertex within a node, and what it would take from the node's corners.
struct NodeProbe {
  ElementVertexId vertex;
  std::array<float, 4> weight; ///< of the corners
  bool indicator_only = false;     ///< no part has it for a corner
};

/// m^2, of the elements below a node.
double area_below(const ElementMesh& mesh, const NodeTree& tree, TreeNodeId node);

/// The corners of a node; a triangle repeats its third.
ElementCorners corners_of(const ElementMesh& mesh, const TreeNode& node);

/// Those corners of a node's parts that are nearest to its middle: one, or two where it has
/// two parts, and then a vertex near the middle, if there is any. None of an element.
std::vector<NodeProbe> probes_of(const ElementMesh& mesh, const NodeTree& tree,
                                 const TreeNode& node);

/// By ElementVertexId, where the nodes need indirect light, at corners and in the middle:
/// the area of the largest node that does, m^2, elsewhere 0.
std::vector<double> wanted_vertices(const ElementMesh& mesh, const NodeTree& tree,
                                    std::span<const TreeNodeId> nodes);

/// Of a cut through the tree: no node is above another.
InterpolationWeights vertex_shares(const ElementMesh& mesh, const NodeTree& tree,
                           std::span<const TreeNodeId> nodes);

} // namespace meninas
