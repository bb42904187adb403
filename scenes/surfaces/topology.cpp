#include "scenes/surfaces/topology.h"

#include "scenes/surfaces/neighbour_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace meninas {
namespace {

/// Welds a vertex to those added before that stand where it stands.
class Welder {
public:
  Welder(const Scene& scene, double largest_distance)
      : scene_(scene), origin_(bounds_of(scene).low), largest_(largest_distance),
        grid_(8.0 * largest_distance, scene.vertices.size()) {}

  /// `distance` of two vertices is the mean of what is said of each.
  VertexId add(std::size_t i, double distance) {
    const Point3& here = scene_.vertices[i].position;
    const Vec3 from_origin = here - origin_;
    const NeighbourGrid<3>::Point key{from_origin.x, from_origin.y, from_origin.z};
    VertexId welded{static_cast<std::uint32_t>(i)};
    grid_.visit_near(key, 0.5 * (distance + largest_), [&](std::uint32_t entry) {
      const auto& [other, its_distance] = added_[entry];
      if (glm::distance(here, position(scene_, other)) <= 0.5 * (distance + its_distance)) {
        welded = std::min(welded, other);
      }
      return true;
    });
    if (index(welded) == i) {
      grid_.add(key, static_cast<std::uint32_t>(added_.size()));
      added_.push_back({welded, distance});
    }
    return welded;
  }

private:
  struct Added {
    VertexId vertex;
    double distance;
  };

  const Scene& scene_;
  Point3 origin_;
  double largest_;
  NeighbourGrid<3> grid_;
  std::vector<Added> added_;
};

std::vector<VertexId> weld(const Scene& scene, double distance) {
  std::vector<VertexId> welded(scene.vertices.size());
  if (!welded.empty()) {
    Welder welder(scene, distance);
    for (std::size_t i = 0; i < welded.size(); ++i) {
      welded[i] = welder.add(i, distance);
    }
  }
  return welded;
}

std::vector<VertexId> weld(const Scene& scene, const Precision& precision) {
  const double near = 0.5 * precision.in_detail();
  if (precision.detail().is_all) {
    return weld(scene, near);
  }
  double largest = near;
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    largest = std::max(largest, 0.5 * precision.at(static_cast<VertexId>(i)));
  }
  std::vector<VertexId> welded(scene.vertices.size());
  Welder within(scene, near), beyond(scene, largest);
  for (std::size_t i = 0; i < welded.size(); ++i) {
    const double distance = 0.5 * precision.at(static_cast<VertexId>(i));
    welded[i] = (distance <= near ? within : beyond).add(i, distance);
  }
  return welded;
}

/// Calls `take(use)` for the sides of all triangles in their order.
template <typename Take>
void for_each_use(const Scene& scene, const std::vector<VertexId>& welded, const Take& take) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    for (std::uint8_t side = 0; side < 3; ++side) {
      const VertexId from = welded[index(scene.triangles[t].vertices[side])];
      const VertexId to = welded[index(scene.triangles[t].vertices[(side + 1) % 3])];
      if (from != to) {
        take(EdgeUse{std::min(from, to), std::max(from, to), TriangleId{t}, side, from < to});
      }
    }
  }
}

/// Sorted by their lower ends first, which are counted; few of them share one.
std::vector<EdgeUse> edge_uses(const Scene& scene, const std::vector<VertexId>& welded) {
  std::vector<std::uint32_t> first(scene.vertices.size() + 1, 0);
  for_each_use(scene, welded, [&](const EdgeUse& use) { ++first[index(use.low) + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<EdgeUse> uses(first.back());
  std::vector<std::uint32_t> next = first;
  for_each_use(scene, welded, [&](const EdgeUse& use) { uses[next[index(use.low)]++] = use; });
  tbb::parallel_for(std::size_t{0}, scene.vertices.size(), [&](std::size_t v) {
    std::sort(uses.begin() + first[v], uses.begin() + first[v + 1],
              [](const EdgeUse& a, const EdgeUse& b) {
                return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
              });
  });
  return uses;
}

Topology topology_of(const Scene& scene, std::vector<VertexId> welded) {
  Topology topology;
  topology.welded = std::move(welded);
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

} // namespace

Topology find_topology(const Scene& scene, double weld_distance) {
  return topology_of(scene, weld(scene, weld_distance));
}

Topology find_topology(const Scene& scene, const Precision& precision) {
  return topology_of(scene, weld(scene, precision));
}

} // namespace meninas
