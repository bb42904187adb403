#include "scenes/topology.h"

#include "scenes/neighbour_grid.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

namespace meninas {
namespace {

std::vector<VertexId> weld(const Scene& scene, double distance) {
  std::vector<VertexId> welded(scene.vertices.size());
  if (welded.empty()) {
    return welded;
  }
  const Point3 origin = bounds_of(scene).low;
  NeighbourGrid<3> grid(8.0 * distance, welded.size());
  for (std::size_t i = 0; i < welded.size(); ++i) {
    const Point3& here = scene.vertices[i].position;
    const Vec3 from_origin = here - origin;
    const NeighbourGrid<3>::Point key{from_origin.x, from_origin.y, from_origin.z};
    welded[i] = static_cast<VertexId>(i);
    grid.visit_near(key, distance, [&](std::uint32_t other) {
      if (glm::distance(here, scene.vertices[other].position) <= distance) {
        welded[i] = std::min(welded[i], static_cast<VertexId>(other));
      }
      return true;
    });
    if (index(welded[i]) == i) {
      grid.add(key, static_cast<std::uint32_t>(i));
    }
  }
  return welded;
}

std::vector<EdgeUse> edge_uses(const Scene& scene, const std::vector<VertexId>& welded) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * scene.triangles.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    for (std::uint8_t side = 0; side < 3; ++side) {
      const VertexId from = welded[index(scene.triangles[t].vertices[side])];
      const VertexId to = welded[index(scene.triangles[t].vertices[(side + 1) % 3])];
      if (from != to) {
        uses.push_back(
            {std::min(from, to), std::max(from, to), static_cast<TriangleId>(t), side, from < to});
      }
    }
  }
  tbb::parallel_sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  });
  return uses;
}

} // namespace

Topology find_topology(const Scene& scene, double weld_distance) {
  Topology topology;
  topology.welded = weld(scene, weld_distance);
  topology.uses = edge_uses(scene, topology.welded);
  topology.edge_of.assign(scene.triangles.size(), {no_edge, no_edge, no_edge});
  for (std::size_t i = 0; i < topology.uses.size(); ++i) {
    const EdgeUse& use = topology.uses[i];
    if (i == 0 || use.low != topology.uses[i - 1].low || use.high != topology.uses[i - 1].high) {
      topology.first_use.push_back(static_cast<std::uint32_t>(i));
    }
    topology.edge_of[index(use.triangle)][use.side] =
        static_cast<std::uint32_t>(topology.first_use.size() - 1);
  }
  topology.first_use.push_back(static_cast<std::uint32_t>(topology.uses.size()));
  return topology;
}

} // namespace meninas
