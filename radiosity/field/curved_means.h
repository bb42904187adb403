// Means over elements of light that is known at their corners.
//
// The mean of the corners is that of straight light. Light is hollow over walls, and elements would
// send too little: with second differences along the edges (vertex_edges.h)
//
//   mean = 1/4 sum f_c - s_u^2 f_uu / 12 - s_v^2 f_vv / 12,
//
// the trapezoidal rule with the first term of its error (Euler and Maclaurin), not below 0 nor above
// twice the largest f_c. f'' is the mean over the corners at which an edge along u, or v, goes on.
// Triangles, and surfaces of one element, have the mean of their corners.
#pragma once

#include "radiosity/mesh/vertex_edges.h"

namespace meninas {

/// By ElementId, in the units of `values` (W/m^2). `values` by ElementVertexId.
std::vector<Rgb> curved_means(const ElementMesh& mesh, const VertexEdges& edges,
                              std::span<const glm::vec3> values);

} // namespace meninas
