#include "mirror/antipenumbra.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

struct Sides {
  double low = 0.0, high = 0.0; ///< signed distances from a plane
};

Sides sides_of(const ConvexPolygon& polygon, const Point3& on_plane, const Vec3& normal) {
  Sides sides;
  for (const auto& vertex : polygon.span()) {
    const double distance = glm::dot(normal, vertex - on_plane);
    sides.low = std::min(sides.low, distance);
    sides.high = std::max(sides.high, distance);
  }
  return sides;
}

/// The size of everything that takes part,
/// or that of the rounding of its coordinates where that is more.
double extent_of(std::initializer_list<const ConvexPolygon*> polygons, const Point3& origin) {
  double extent = 0.0;
  for (const auto* polygon : polygons)
    for (const auto& vertex : polygon->span())
      extent = std::max({extent, glm::distance(vertex, origin), 1e-6 * glm::length(vertex)});
  return extent;
}

/// Cuts the polygon along every plane through an edge of `edges` and a corner
/// of `corners` that holds the two apart, on the side of `second`, which is one of them.
ConvexPolygon clip_by_separators(ConvexPolygon polygon, const ConvexPolygon& edges,
                                 const ConvexPolygon& corners, const ConvexPolygon& second) {
  const double extent = extent_of({&polygon, &edges, &corners}, edges.vertices[0]);
  const double rounding = 1e-9 * extent, shortest = 1e-6 * extent;
  const bool second_has_edges = &second == &edges;
  for (std::size_t k = 0; k < edges.size && !polygon.empty(); ++k) {
    const Point3& from = edges.vertices[k];
    const Vec3 along = edges.vertices[k + 1 < edges.size ? k + 1 : 0] - from;
    if (glm::length(along) < shortest)
      continue;
    for (const auto& corner : corners.span()) {
      Vec3 normal = glm::cross(along, corner - from);
      const double length = glm::length(normal);
      if (length <= shortest * glm::length(along))
        continue;
      normal /= length;
      const Sides there = sides_of(corners, from, normal);
      if (-there.low > there.high)
        normal = -normal;

      // The corners' polygon in front, the edges' behind, and both off the plane somewhere:
      // it holds them apart.
      const Sides front = sides_of(corners, from, normal), behind = sides_of(edges, from, normal);
      if (front.low < -rounding || front.high <= rounding || behind.high > rounding ||
          behind.low >= -rounding)
        continue;
      polygon = second_has_edges ? clip(polygon, from + rounding * normal, -normal)
                                 : clip(polygon, from - rounding * normal, normal);
    }
  }
  return polygon;
}

} // namespace

ConvexPolygon clip_to_penumbra(const ConvexPolygon& polygon, const ConvexPolygon& first,
                               const ConvexPolygon& second) {
  if (first.empty() || second.empty())
    return polygon;
  return clip_by_separators(clip_by_separators(polygon, first, second, second), second, first,
                            second);
}

} // namespace meninas
