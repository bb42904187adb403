#include "scenes/surfaces/closedness.h"

#include "scenes/surfaces/topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace meninas {
namespace {

constexpr std::size_t max_divided_edges = 4096;

/// Pairs of numbers, by the first of them.
struct Lists {
  std::vector<std::uint32_t> begin; ///< by first, and the end
  std::vector<std::uint32_t> second;

  std::span<const std::uint32_t> of(std::uint32_t first) const {
    return std::span(second).subspan(begin[first], begin[first + 1] - begin[first]);
  }
};

/// Which faces meet at which edge. A long edge that others lie on is replaced by its pieces.
struct Incidence {
  Lists edges_of_face;
  Lists faces_of_edge;
};

/// The pairs the other way round.
Lists turned_round(const Lists& lists, std::uint32_t count) {
  Lists turned{std::vector<std::uint32_t>(count + 1, 0), {}};
  for (const std::uint32_t to : lists.second) {
    ++turned.begin[to + 1];
  }
  std::partial_sum(turned.begin.begin(), turned.begin.end(), turned.begin.begin());
  turned.second.resize(lists.second.size());
  std::vector<std::uint32_t> next = turned.begin;
  for (std::uint32_t from = 0; from + 1 < lists.begin.size(); ++from) {
    for (const std::uint32_t to : lists.of(from)) {
      turned.second[next[to]++] = from;
    }
  }
  return turned;
}

struct LooseEdge {
  std::uint32_t edge;
  VertexId low, high;
};

/// The edges only one face has.
std::vector<LooseEdge> loose_edges(const Topology& topology) {
  std::vector<LooseEdge> loose;
  for (std::uint32_t edge = 0; edge + 1 < topology.first_use.size(); ++edge) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 1) {
      loose.push_back({edge, uses[0].low, uses[0].high});
    }
  }
  return loose;
}

/// The welded vertices on the segment from low to high, its ends included, in order.
std::vector<VertexId> vertices_along(const Scene& scene, const LooseEdge& edge,
                                     const std::vector<VertexId>& candidates, double tolerance) {
  const Point3& a = position(scene, edge.low);
  const Vec3 along = position(scene, edge.high) - a;
  const double length = glm::length(along);
  const Direction direction = along / length;
  std::vector<std::pair<double, VertexId>> found;
  for (const VertexId vertex : candidates) {
    const Vec3 to = position(scene, vertex) - a;
    const double distance = glm::dot(to, direction);
    const bool between = distance > tolerance && distance < length - tolerance;
    if (between && glm::length(to - distance * direction) <= tolerance) {
      found.emplace_back(distance, vertex);
    }
  }
  std::ranges::sort(found);
  std::vector<VertexId> vertices{edge.low};
  for (const auto& [distance, vertex] : found) {
    vertices.push_back(vertex);
  }
  vertices.push_back(edge.high);
  return vertices;
}

/// Every loose edge as the pieces the ends of other loose edges divide it into;
/// a piece has one number, whoever has it.
std::map<std::uint32_t, std::vector<std::uint32_t>>
divide_loose_edges(const Scene& scene, const std::vector<LooseEdge>& loose,
                   std::uint32_t first_number, double tolerance) {
  std::vector<VertexId> ends;
  for (const LooseEdge& edge : loose) {
    ends.insert(ends.end(), {edge.low, edge.high});
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

  std::map<std::pair<VertexId, VertexId>, std::uint32_t> numbers;
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces;
  for (const LooseEdge& edge : loose) {
    const std::vector<VertexId> vertices = vertices_along(scene, edge, ends, tolerance);
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const auto key = std::minmax(vertices[k], vertices[k + 1]);
      const auto next = first_number + static_cast<std::uint32_t>(numbers.size());
      pieces[edge.edge].push_back(numbers.emplace(key, next).first->second);
    }
  }
  return pieces;
}

Incidence find_incidence(const Scene& scene, double tolerance) {
  const Topology topology = find_topology(scene, tolerance);
  const auto edge_count = static_cast<std::uint32_t>(topology.first_use.size() - 1);
  const std::vector<LooseEdge> loose = loose_edges(topology);
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces;
  if (loose.size() <= max_divided_edges) {
    pieces = divide_loose_edges(scene, loose, edge_count, tolerance);
  }

  Lists edges{{0}, {}};
  edges.begin.reserve(scene.triangles.size() + 1);
  edges.second.reserve(3 * scene.triangles.size());
  std::uint32_t count = edge_count;
  for (const auto& of_face : topology.edge_of) {
    for (const std::uint32_t edge : of_face) {
      const auto divided = pieces.find(edge);
      if (edge != no_edge && divided == pieces.end()) {
        edges.second.push_back(edge);
      } else if (edge != no_edge) {
        edges.second.insert(edges.second.end(), divided->second.begin(), divided->second.end());
        count = std::max(count, std::ranges::max(divided->second) + 1);
      }
    }
    edges.begin.push_back(static_cast<std::uint32_t>(edges.second.size()));
  }
  Lists faces = turned_round(edges, count);
  return {std::move(edges), std::move(faces)};
}

/// Peels faces with bare edges until there is none; 1 for the faces that stay.
std::vector<std::uint8_t> shell_of(const Incidence& incidence) {
  const auto& [edges_of_face, faces_of_edge] = incidence;
  std::vector<std::uint8_t> stays(edges_of_face.begin.size() - 1, 1);
  std::vector<std::uint32_t> sharers;
  std::vector<std::uint32_t> bare;
  for (std::uint32_t edge = 0; edge + 1 < faces_of_edge.begin.size(); ++edge) {
    sharers.push_back(static_cast<std::uint32_t>(faces_of_edge.of(edge).size()));
    if (sharers.back() == 1) {
      bare.push_back(edge);
    }
  }
  while (!bare.empty()) {
    const std::uint32_t edge = bare.back();
    bare.pop_back();
    for (const std::uint32_t face : faces_of_edge.of(edge)) {
      if (stays[face] == 0) {
        continue;
      }
      stays[face] = 0;
      for (const std::uint32_t other : edges_of_face.of(face)) {
        if (--sharers[other] == 1) {
          bare.push_back(other);
        }
      }
    }
  }
  return stays;
}

} // namespace

bool is_closed(const Scene& scene, double tolerance) {
  if (scene.triangles.empty()) {
    return false;
  }
  const std::vector<std::uint8_t> stays = shell_of(find_incidence(scene, tolerance));
  Bounds shell;
  for (std::uint32_t face = 0; face < stays.size(); ++face) {
    if (stays[face] == 0) {
      continue;
    }
    for (const Point3& corner : corners(scene, TriangleId{face})) {
      shell.low = glm::min(shell.low, corner);
      shell.high = glm::max(shell.high, corner);
    }
  }
  const Bounds all = bounds_of(scene);
  const Vec3 slack(tolerance);
  return glm::all(glm::lessThanEqual(shell.low, all.low + slack)) &&
         glm::all(glm::greaterThanEqual(shell.high, all.high - slack));
}

} // namespace meninas
