#include "scenes/report/mesh_oddities.h"

#include "scenes/surfaces/point_tree.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

namespace meninas {
namespace {

constexpr double sliver_aspect = 1000.0;
constexpr std::size_t crowd = 1000; ///< faces at one corner

// Among loose triangles that all cross each other every edge has every corner near it;
// what is looked at ends there.
constexpr std::size_t max_points_tried = 20'000'000;

NodeId node_of(const Scene& scene, TriangleId triangle) {
  return scene.triangles[index(triangle)].node;
}

/// A face by its welded corners, whichever it begins with.
struct FaceKey {
  std::array<VertexId, 3> corners; ///< sorted
  bool turned = false;             ///< the sorted corners go round the other way
  TriangleId triangle = none<TriangleId>;
};

std::vector<FaceKey> face_keys(const Scene& scene, const Topology& topology) {
  std::vector<FaceKey> keys;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    FaceKey key{.corners = scene.triangles[t].vertices, .triangle = TriangleId{t}};
    for (VertexId& corner : key.corners) {
      corner = topology.welded[index(corner)];
    }
    auto& c = key.corners;
    std::ranges::rotate(c, std::ranges::min_element(c));
    key.turned = c[1] > c[2];
    std::ranges::sort(c);
    if (c[0] != c[1] && c[1] != c[2]) {
      keys.push_back(key);
    }
  }
  tbb::parallel_sort(keys.begin(), keys.end(), [](const FaceKey& a, const FaceKey& b) {
    return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
  });
  return keys;
}

bool is_copy(const Scene& scene, const FaceKey& first, const FaceKey& second) {
  return first.turned == second.turned || material_of(scene, first.triangle).double_sided ||
         material_of(scene, second.triangle).double_sided;
}

template <typename Visit>
void each_edge(const Topology& topology, Visit visit) {
  for (std::uint32_t edge = 0; edge + 1 < topology.first_use.size(); ++edge) {
    visit(uses_of(topology, edge));
  }
}

bool lies_inside(const Point3& x, const Point3& a, const Point3& b, double tolerance) {
  const Vec3 along = b - a;
  const double length = glm::length(along);
  const double distance = glm::dot(x - a, along) / length;
  return distance > tolerance && distance < length - tolerance &&
         glm::length(x - a - along * (distance / length)) <= tolerance;
}

} // namespace

CountByNodes duplicate_faces(const Scene& scene, const Topology& topology) {
  const std::vector<FaceKey> keys = face_keys(scene, topology);
  CountByNodes counts;
  for (std::size_t begin = 0, k = 1; k < keys.size(); ++k) {
    if (keys[k].corners != keys[begin].corners) {
      begin = k;
      continue;
    }
    // A face is compared with those before it; a third copy is found by the first.
    for (std::size_t first = begin; first < std::min(k, begin + 2); ++first) {
      if (is_copy(scene, keys[first], keys[k])) {
        ++counts[{node_of(scene, keys[k].triangle), node_of(scene, keys[first].triangle)}];
        break;
      }
    }
  }
  return counts;
}

CountByNode crowded_edges(const Scene& scene, const Topology& topology) {
  CountByNode counts;
  each_edge(topology, [&](std::span<const EdgeUse> uses) {
    if (uses.size() < 3) {
      return;
    }
    std::map<NodeId, std::size_t> sharers;
    for (const EdgeUse& use : uses) {
      if (++sharers[node_of(scene, use.triangle)] == 3) {
        ++counts[node_of(scene, use.triangle)];
      }
    }
  });
  return counts;
}

CountByNode divided_edges(const Scene& scene, const Topology& topology, double tolerance) {
  std::vector<EdgeUse> loose;
  each_edge(topology, [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 1) {
      loose.push_back(uses.front());
    }
  });
  std::vector<Point3> ends;
  for (const EdgeUse& edge : loose) {
    ends.push_back(position(scene, edge.low));
    ends.push_back(position(scene, edge.high));
  }
  const PointTree tree(ends);
  CountByNode counts;
  std::size_t tried = 0;
  for (const EdgeUse& edge : loose) {
    if (tried > max_points_tried) {
      break;
    }
    const Point3& a = position(scene, edge.low);
    const Point3& b = position(scene, edge.high);
    bool divided = false;
    tree.visit_inside({glm::min(a, b) - tolerance, glm::max(a, b) + tolerance},
                      [&](std::uint32_t k) {
                        ++tried;
                        divided = lies_inside(ends[k], a, b, tolerance);
                        return !divided;
                      });
    if (divided) {
      ++counts[node_of(scene, edge.triangle)];
    }
  }
  return counts;
}

CountByNode crowded_corners(const Scene& scene, const Topology& topology) {
  std::vector<std::uint32_t> faces(topology.welded.size(), 0);
  const auto corner = [&](VertexId vertex) { return topology.welded[index(vertex)]; };
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      ++faces[index(corner(vertex))];
    }
  }
  std::vector<std::pair<VertexId, NodeId>> uses; // of corners that are crowded by all nodes together
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      if (faces[index(corner(vertex))] > crowd) {
        uses.emplace_back(corner(vertex), triangle.node);
      }
    }
  }
  std::ranges::sort(uses);
  CountByNode counts;
  for (auto begin = uses.begin(); begin != uses.end();) {
    const auto end = std::upper_bound(begin, uses.end(), *begin);
    if (std::size_t(end - begin) > crowd) {
      ++counts[begin->second];
    }
    begin = end;
  }
  return counts;
}

CountByNode slivers(const Scene& scene) {
  CountByNode counts;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto p = corners(scene, TriangleId{t});
    const double longest =
        std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    if (2.0 * glm::length(area_vector(p)) * sliver_aspect < longest * longest) {
      ++counts[scene.triangles[t].node];
    }
  }
  return counts;
}

} // namespace meninas
