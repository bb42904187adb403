// Which vertices gather indirect light, and what those between take from them, where receivers stand for many elements.
//
// The corners of receivers gather; inside a receiver the light is smooth, and a vertex takes the bilinear mean of the corners, linear in
// triangles. A vertex on the border of a large and a small receiver takes from the small one, or is a corner of it: every vertex has one value,
// so that there is no crack.
#pragma once

#include "radiosity/hierarchical/node_cut.h"

namespace meninas {

/// By ElementVertexId. A vertex that gathers takes all of its own value.
struct VertexShares {
  std::vector<std::array<ElementVertexId, 4>> from;
  std::vector<std::array<float, 4>> weight; ///< sum 1
};

/// Whether a vertex takes from itself alone.
inline bool gathers(const VertexShares& shares, std::size_t vertex) {
  return index(shares.from[vertex][0]) == vertex;
}

VertexShares vertex_shares(const ElementMesh& mesh, const NodeTree& tree, const NodeCut& cut);

} // namespace meninas
