// Nodes over which indirect light is interpolated:
// as large as bilinear interpolation between their corners allows.
//
// Receivers are small enough for what they send on;
// what is seen of them is interpolated, and where light bends it takes more corners.
// At a vertex p in the middle of a node (node_vertices.h) light is gathered as well; where
//
//   rho |I_p - sum of its corners' shares| sqrt(A / A_mean)  >  2 X (rho H_p + B_mean / 20)
//
// the node gives way to its parts, as it does where some of these vertices have
// light and others are covered. A is the node's area and A_mean that of a receiver:
// equal squares over equal areas. I is the indirect part of the irradiance H.
// So do the two nodes on both sides of an edge,
// if light in the middle of that is as far from the mean of its ends (node_edges.h).
#pragma once

#include "radiosity/field/interpolation_error.h"
#include "radiosity/hierarchical/node_vertices.h"

namespace meninas {

/// The light gathered so far, by ElementVertexId.
struct GatheredVertices {
  std::span<const std::uint8_t> valid; ///< whether a vertex has a value of its own
  std::span<const glm::vec3> irradiance, indirect;
};

struct BendBound {
  BendScale scale; ///< its area that of a receiver
  double x = 0.0;
};

/// The parts of those nodes that are bent; the others are added to `straight`.
std::vector<TreeNodeId> parts_of_bent(const ElementMesh& mesh, const NodeTree& tree,
                                      std::span<const TreeNodeId> nodes,
                                      const GatheredVertices& gathered, const BendBound& bound,
                                      std::vector<TreeNodeId>& straight);

/// The parts of those of the `straight` nodes, taken from these, that have bent edges.
std::vector<TreeNodeId> parts_at_bent_edges(const ElementMesh& mesh, const NodeTree& tree,
                                            const GatheredVertices& gathered,
                                            const BendBound& bound,
                                            std::vector<TreeNodeId>& straight);

} // namespace meninas
