// The edges along which triangles touch, whatever vertices the exporter split. (Used by
// find_surfaces and report_scene.)
#pragma once

#include "scenes/surfaces/precision.h"

#include <span>

namespace meninas {

/// One side of a triangle, from its corner `side` to the next one.
struct EdgeUse {
  VertexId low = none<VertexId>; ///< welded ends, low < high
  VertexId high = none<VertexId>;
  TriangleId triangle = none<TriangleId>;
  std::uint8_t side = 0;
  bool forward = true; ///< the triangle runs from low to high
};

struct Topology {
  std::vector<VertexId> welded; ///< per vertex, the first vertex that stands where it stands
  std::vector<EdgeUse> uses;    ///< sorted by edge, then by triangle
  std::vector<std::uint32_t> first_use; ///< per edge its first use, and the end
  std::vector<std::array<std::uint32_t, 3>>
      edge_of; ///< per triangle and side; no_edge where both ends are one point
};

inline constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();

/// Vertices not farther apart than `weld_distance` count as one.
Topology find_topology(const Scene& scene, double weld_distance);

/// The same for copies of one point, which are each off by their position error:
/// half the tolerance apart at most. Vertices far beyond the detail are welded among themselves.
Topology find_topology(const Scene& scene, const Precision& precision);

inline std::span<const EdgeUse> uses_of(const Topology& topology, std::uint32_t edge) {
  const std::size_t first = topology.first_use[edge];
  return std::span(topology.uses).subspan(first, topology.first_use[edge + 1] - first);
}

} // namespace meninas
