// The vertices that gather indirect light where nodes stand for many elements, and the weights by which the
// vertices between interpolate.
//
// The corners of a node gather, and a vertex in its middle, which tells whether light is straight
// between them (node_bends.h). The parts share that vertex. Their other corners are interpolated between
// corners of this node, unless they gather as corners of another.
// A node of two parts has two such vertices, on its long edges. They miss curvature between them.
// A third sample near the middle serves as indicator only; its value is not stored.
// A vertex within a part takes the bilinear mean of the part's corners, H = sum w_k H_k, linear in triangles.
// One on the border of a large and a small part takes from the small one, or is a corner of it:
// every vertex has one value, so that there is no crack.
#pragma once

#include "radiosity/transport/substructuring.h"

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

/// The probes of a node: the corners of its parts that are nearest to its middle, one, or two where it has
/// two parts, and then a vertex near the middle, if there is any. An element has none.
std::vector<NodeProbe> probes_of(const ElementMesh& mesh, const NodeTree& tree,
                                 const TreeNode& node);

/// By ElementVertexId, where the nodes need indirect light, at corners and in the middle:
/// the area of the largest node that does, m^2, elsewhere 0.
std::vector<double> wanted_vertices(const ElementMesh& mesh, const NodeTree& tree,
                                    std::span<const TreeNodeId> nodes);

/// The weights for a cut through the tree: no node is above another.
InterpolationWeights vertex_shares(const ElementMesh& mesh, const NodeTree& tree,
                           std::span<const TreeNodeId> nodes);

} // namespace meninas
