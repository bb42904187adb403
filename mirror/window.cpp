#include "mirror/window.h"

#include <cmath>
#include <map>
#include <optional>

namespace meninas {

namespace {

constexpr std::size_t max_corners = 16; ///< of a merged polygon: room for the clips of a chain

using Cell = std::array<std::int64_t, 3>;
using EdgeKey = std::pair<Cell, Cell>;

Cell cell_of(const Point3& x, double size) {
  Cell cell;
  for (int k = 0; k < 3; ++k)
    cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(x[k] / size + 0.37));
  return cell;
}

/// Corners that turn: those on a straight line between their neighbours are dropped.
ConvexPolygon without_straight_corners(const std::vector<Point3>& corners, double tolerance) {
  ConvexPolygon polygon;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point3 &before = corners[(k + n - 1) % n], &here = corners[k],
                 &after = corners[(k + 1) % n];
    const Vec3 chord = after - before;
    const double height = glm::length(glm::cross(here - before, chord)) / glm::length(chord);
    if (height > tolerance && polygon.size < ConvexPolygon::capacity)
      polygon.push_back(here);
  }
  return polygon;
}

bool is_convex(const ConvexPolygon& polygon) {
  const Vec3 front = area_vector(polygon.span());
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Point3 &a = polygon.vertices[k], &b = polygon.vertices[(k + 1) % polygon.size],
                 &c = polygon.vertices[(k + 2) % polygon.size];
    if (glm::dot(glm::cross(b - a, c - b), front) <= 0.0)
      return false;
  }
  return polygon.size >= 3;
}

/// The union across edge i of a and edge j of b, which run along each other in opposite directions;
/// nothing if it is not convex.
std::optional<ConvexPolygon> merged(const ConvexPolygon& a, std::size_t i, const ConvexPolygon& b,
                                    std::size_t j, double tolerance) {
  std::vector<Point3> corners;
  for (std::size_t k = 1; k <= a.size; ++k)
    corners.push_back(a.vertices[(i + k) % a.size]);
  for (std::size_t k = 2; k < b.size; ++k)
    corners.push_back(b.vertices[(j + k) % b.size]);
  const ConvexPolygon both = without_straight_corners(corners, tolerance);
  if (both.size > max_corners || !is_convex(both))
    return std::nullopt;
  return both;
}

/// Directed edges of the polygons that are still there.
class EdgeTable {
public:
  explicit EdgeTable(double cell) : cell_(cell) {}
  void add(const ConvexPolygon& polygon, std::size_t id) {
    for (std::size_t k = 0; k < polygon.size; ++k)
      edges_[key(polygon, k)] = {id, k};
  }
  void remove(const ConvexPolygon& polygon) {
    for (std::size_t k = 0; k < polygon.size; ++k)
      edges_.erase(key(polygon, k));
  }
  /// Polygon and edge that run along edge k the other way.
  std::optional<std::pair<std::size_t, std::size_t>> opposite(const ConvexPolygon& polygon,
                                                              std::size_t k) const {
    const auto [from, to] = key(polygon, k);
    const auto found = edges_.find({to, from});
    if (found == edges_.end())
      return std::nullopt;
    return found->second;
  }

private:
  EdgeKey key(const ConvexPolygon& polygon, std::size_t k) const {
    return {cell_of(polygon.vertices[k], cell_),
            cell_of(polygon.vertices[(k + 1) % polygon.size], cell_)};
  }
  double cell_;
  std::map<EdgeKey, std::pair<std::size_t, std::size_t>> edges_;
};

/// Corners are told apart by cells of 16 tolerances; `straight` as of merge_convex().
void merge_all(std::vector<ConvexPolygon>& polygons, double tolerance, double straight) {
  EdgeTable edges(16.0 * tolerance);
  for (std::size_t p = 0; p < polygons.size(); ++p)
    edges.add(polygons[p], p);

  // Each polygon grows as far as it can, which makes rows or columns of tiles;
  // the next round joins those.
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      for (std::size_t k = 0; k < polygons[p].size;) {
        const auto other = edges.opposite(polygons[p], k);
        const auto both =
            other && other->first != p
                ? merged(polygons[p], k, polygons[other->first], other->second, straight)
                : std::nullopt;
        if (!both) {
          ++k;
          continue;
        }
        edges.remove(polygons[p]);
        edges.remove(polygons[other->first]);
        polygons[other->first].size = 0;
        polygons[p] = *both;
        edges.add(polygons[p], p);
        changed = true;
        k = 0;
      }
    }
  }
  std::erase_if(polygons, [](const ConvexPolygon& polygon) { return polygon.empty(); });
}

} // namespace

std::vector<ConvexPolygon> merge_convex(std::vector<ConvexPolygon> polygons, double tolerance,
                                        double straight) {
  constexpr std::size_t many = 16;
  std::vector<ConvexPolygon> exact = polygons;
  merge_all(exact, tolerance, tolerance);
  if (exact.size() <= many || !(straight > tolerance))
    return exact;
  merge_all(polygons, tolerance, straight);
  return polygons.size() < exact.size() ? polygons : exact;
}

} // namespace meninas
