// Pairs of triangles that make one quad. (Used by find_surfaces alone.)
#pragma once

#include "scenes/surfaces/regions.h"
#include "scenes/surfaces/topology.h"

namespace meninas {

/// A quad of two triangles, its vertices counter-clockwise seen from the front.
struct QuadPair {
  TriangleId first = none<TriangleId>; ///< first < second
  TriangleId second = none<TriangleId>;
  std::array<VertexId, 4> vertices{};
};

/// Disjoint pairs of triangles of one node and one region that share an edge and form a strictly
/// convex quad, taken greedily, those nearest to a rectangle first; ordered by their first
/// triangles.
std::vector<QuadPair> pair_triangles(const Scene& scene, const Regions& regions,
                                     const Topology& topology);

} // namespace meninas
