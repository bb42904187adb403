// Indirect light at the corners of nodes (node_bends.h), and at the vertices between them.
//
// Light is gathered, W/m^2, at the corners and in the middle of nodes; where it bends by more than X
// the node gives way to its parts. A vertex of the mesh takes the bilinear shares of its node's corners
// (node_vertices.h), and along bent edges what is curved as well (node_edges.h).
#pragma once

#include "radiosity/field/final_gathering.h"
#include "radiosity/hierarchical/node_bends.h"
#include "radiosity/hierarchical/node_edges.h"
#include "radiosity/hierarchical/node_vertices.h"
#include "radiosity/hierarchical/receiver_nodes.h"

namespace meninas {

/// The first gathering, and small nodes, have so many times fewer rays.
inline constexpr int ray_reduction = 4;

/// The light that nodes gather from: the same light, with many and with few rays.
struct NodeSource {
  const VertexSource& many;
  const VertexSource& few;
};

/// The interpolation from the vertices that gather to all others.
struct NodeInterpolation {
  InterpolationWeights shares;
  std::vector<MidpointStencil> crosses;
};

/// Takes the nodes of which nothing is seen from these. `seen` by ElementId; empty: every element is.
std::vector<TreeNodeId> take_unseen(const NodeTree& tree, std::span<const std::uint8_t> seen,
                                    std::vector<TreeNodeId>& nodes);

/// Indirect light at the corners and in the middle of nodes as small as it asks for, with a bound of X.
/// Middles alone do not see light that bends one way along a node and the other way across:
/// what edges between nodes tell of that divides once more.
NodeInterpolation gather_at_nodes(const NodeSource& source, const HierarchicalSolution& receivers,
                                  std::vector<TreeNodeId> nodes,
                                  std::span<const std::uint8_t> seen, double x,
                                  VertexSamples& found);

/// Gives vertices that have direct light their indirect light:
/// first those between corners of nodes, which others take from.
void share_out(const NodeInterpolation& by, VertexSamples& found);

} // namespace meninas
