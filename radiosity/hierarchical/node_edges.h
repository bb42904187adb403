// Irradiance, W/m^2, in the middle of edges between nodes, where it is curved.
//
// A node of four parts gathers at its corners and in its middle,
// and its parts need values in the middle m of its edges, too.
// These lie between two nodes A and B. Light that is quadratic along and across the edge,
//
//   I_m = L_m - p,    I_c = (bilinear mean of the corners)_c - p - q k_c   in the middle c = A, B of the nodes,
//   I_m = (linear mean of I_A and I_B)_m - q a b,
//
// L_m linear between the ends of the edge, a and b the distances from m to the middles of A and B,
// k the product of a middle's distances to both edges of its node that run along this one,
// has two unknowns, p and q, which the differences d_c of the middles from
// their corners and D = (linear mean of I_A and I_B)_m - L_m determine:
//
//   I_m - L_m = -p = (D k + d a b) / (a b + k),   d and k the means of both nodes.
//
// So the parts, within which vertices take bilinear means, follow a parabola from one
// node to the next; without it, light is too dark throughout where it is concave,
// as in the middle of walls, by up to the bend that nodes are allowed.
// Where no node of four parts with the same edge is beside, as at the border of a surface,
// the edge is as far off the line between its ends as the one opposite is, where that is known.
// All others stay straight: edges of triangles, those with nodes of two parts on both sides,
// and those beside middles or corners without light of their own.
#pragma once

#include "radiosity/field/final_gathering.h"
#include "radiosity/hierarchical/node_vertices.h"

namespace meninas {

/// A node of four parts with its vertices. Edge k runs between corners k and k + 1.
struct MidpointStencil {
  TreeNodeId node;
  ElementCorners corners;
  ElementVertexId middle;
  std::array<ElementVertexId, 4> of_edges;
  SideId side;
  Vec2 st;     ///< of the middle in the node
  Vec2 extent; ///< of the node in the patch
};

/// The stencils of the nodes that have four parts and are not triangles, in their order.
std::vector<MidpointStencil> crosses_of(const ElementMesh& mesh, const NodeTree& tree,
                                  std::span<const TreeNodeId> nodes);

/// By ElementVertexId, in the middle of edges that have not gathered: I_m - L_m, W/m^2; 0 elsewhere.
/// `gathered`: 1 where values are known.
std::vector<glm::vec3> edge_bends(std::span<const MidpointStencil> crosses,
                                  std::span<const std::uint8_t> gathered,
                                  std::span<const glm::vec3> values);

} // namespace meninas
