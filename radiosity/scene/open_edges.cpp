#include "radiosity/scene/open_edges.h"

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/topology.h"

#include <algorithm>
#include <map>
#include <utility>

namespace meninas {

namespace {

constexpr std::size_t max_loose_edges = 4096;
constexpr std::size_t max_corners = 32; ///< of a convex polygon: clipping adds some
constexpr std::size_t max_cut = 512;    ///< of an outline that is cut: that takes up to their cube

using EdgeEnds = std::pair<VertexId, VertexId>;

/// The edges only one face has, by their welded ends.
std::vector<EdgeEnds> loose_edges(const Topology& topology) {
  std::vector<EdgeEnds> loose;
  for (std::uint32_t edge = 0; edge + 1 < topology.first_use.size(); ++edge) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 1)
      loose.emplace_back(uses[0].low, uses[0].high);
  }
  return loose;
}

/// The ends of the pieces into which other loose edges divide one.
std::vector<VertexId> divided(const Scene& scene, const EdgeEnds& edge,
                              const std::vector<VertexId>& ends, double tolerance) {
  const Point3 a = position(scene, edge.first);
  const Vec3 along = position(scene, edge.second) - a;
  const double length = glm::length(along);
  std::vector<std::pair<double, VertexId>> between{{0.0, edge.first}, {length, edge.second}};
  for (const VertexId vertex : ends) {
    const Vec3 to = position(scene, vertex) - a;
    const double distance = glm::dot(to, along) / length;
    if (distance > tolerance && distance < length - tolerance &&
        glm::length(to - distance / length * along) <= tolerance)
      between.emplace_back(distance, vertex);
  }
  std::ranges::sort(between);
  std::vector<VertexId> vertices;
  for (const auto& [distance, vertex] : between)
    vertices.push_back(vertex);
  return vertices;
}

/// Loose edges or pieces of them that no other lies on, as neighbours of each vertex.
std::map<VertexId, std::vector<VertexId>> bare_neighbours(const Scene& scene,
                                                          const std::vector<EdgeEnds>& loose,
                                                          double tolerance) {
  std::vector<VertexId> ends;
  for (const EdgeEnds& edge : loose)
    ends.insert(ends.end(), {edge.first, edge.second});
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::map<EdgeEnds, int> faces;
  for (const EdgeEnds& edge : loose) {
    const std::vector<VertexId> vertices = divided(scene, edge, ends, tolerance);
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k)
      ++faces[std::minmax(vertices[k], vertices[k + 1])];
  }
  std::map<VertexId, std::vector<VertexId>> neighbours;
  for (const auto& [edge, count] : faces)
    if (count == 1) {
      neighbours[edge.first].push_back(edge.second);
      neighbours[edge.second].push_back(edge.first);
    }
  return neighbours;
}

/// Closed lines of vertices with two neighbours each.
std::vector<std::vector<Point3>>
closed_lines(const Scene& scene, const std::map<VertexId, std::vector<VertexId>>& neighbours) {
  std::vector<std::vector<Point3>> lines;
  std::map<VertexId, bool> seen;
  for (const auto& [start, unused] : neighbours) {
    std::vector<Point3> line;
    VertexId before = none<VertexId>, at = start;
    bool is_line = true;
    while (!seen[at]) {
      seen[at] = true;
      line.push_back(position(scene, at));
      const auto& next = neighbours.at(at);
      is_line = is_line && next.size() == 2;
      const VertexId onward = next[0] == before && next.size() > 1 ? next[1] : next[0];
      before = at;
      at = onward;
    }
    if (is_line && at == start && line.size() >= 3)
      lines.push_back(std::move(line));
  }
  return lines;
}

bool is_flat(const std::vector<Point3>& line, double tolerance) {
  const Vec3 area = area_vector(line);
  const double length = glm::length(area);
  return length > 0.0 && std::ranges::all_of(line, [&](const Point3& corner) {
           return std::abs(glm::dot(area / length, corner - line.front())) <= tolerance;
         });
}

/// Without the corners at which the line goes straight on.
std::vector<Point3> without_straight(const std::vector<Point3>& line, double tolerance) {
  std::vector<Point3> corners;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point3& before = corners.empty() ? line.back() : corners.back();
    const Point3& after = line[(k + 1) % line.size()];
    const Vec3 along = after - before;
    const double height = glm::length(glm::cross(line[k] - before, along)) / glm::length(along);
    if (height > tolerance)
      corners.push_back(line[k]);
  }
  return corners;
}

double turn(const Point3& a, const Point3& b, const Point3& c, const Vec3& normal) {
  return glm::dot(glm::cross(b - a, c - b), normal);
}

bool is_convex(const std::vector<Point3>& line) {
  const Vec3 normal = area_vector(line);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (turn(line[k], line[(k + 1) % line.size()], line[(k + 2) % line.size()], normal) < 0.0)
      return false;
  return true;
}

/// Whether the corner between its neighbours can be cut off: it juts out, and no other is within.
bool is_ear(const std::vector<Point3>& line, std::size_t k, const Vec3& normal) {
  const std::size_t n = line.size();
  const Point3 &a = line[(k + n - 1) % n], &b = line[k], &c = line[(k + 1) % n];
  if (turn(a, b, c, normal) <= 0.0)
    return false;
  for (std::size_t j = 0; j < n; ++j) {
    if (j == k || j == (k + n - 1) % n || j == (k + 1) % n)
      continue;
    const Point3& p = line[j];
    if (turn(a, b, p, normal) >= 0.0 && turn(b, c, p, normal) >= 0.0 &&
        turn(c, a, p, normal) >= 0.0)
      return false;
  }
  return true;
}

/// A convex outline, in parts that share its first corner.
void cut_fan(std::vector<Point3> line, std::vector<std::vector<Point3>>& polygons) {
  using Offset = std::vector<Point3>::difference_type;
  while (line.size() > max_corners) {
    const auto last = line.begin() + Offset{max_corners};
    polygons.emplace_back(line.begin(), last);
    line.erase(line.begin() + 1, last - 1);
  }
  polygons.push_back(std::move(line));
}

void cut_ears(std::vector<Point3> line, std::vector<std::vector<Point3>>& polygons) {
  const Vec3 normal = area_vector(line);
  while (line.size() > 3) {
    std::size_t ear = 0;
    while (ear < line.size() && !is_ear(line, ear, normal))
      ++ear;
    if (ear == line.size())
      return;
    const std::size_t n = line.size();
    polygons.push_back({line[(ear + n - 1) % n], line[ear], line[(ear + 1) % n]});
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  polygons.push_back(std::move(line));
}

} // namespace

std::vector<std::vector<Point3>> open_polygons(const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<std::vector<Point3>> polygons;
  const double tolerance = surfaces.tolerance;
  const std::vector<EdgeEnds> loose = loose_edges(find_topology(scene, 0.5 * tolerance));
  if (loose.size() > max_loose_edges)
    return polygons;
  for (const std::vector<Point3>& line :
       closed_lines(scene, bare_neighbours(scene, loose, tolerance))) {
    if (!is_flat(line, tolerance))
      continue;
    std::vector<Point3> corners = without_straight(line, tolerance);
    if (corners.size() < 3)
      continue;
    if (is_convex(corners))
      cut_fan(std::move(corners), polygons);
    else if (corners.size() <= max_cut)
      cut_ears(std::move(corners), polygons);
  }
  return polygons;
}

} // namespace meninas
