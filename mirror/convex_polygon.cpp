#include "mirror/convex_polygon.h"

#include <algorithm>
#include <limits>

namespace meninas {

ConvexPolygon::ConvexPolygon(std::span<const Point3> corners) : size(corners.size()) {
  expects(corners.size() <= capacity, "a convex polygon holds at most its capacity of corners");
  std::copy(corners.begin(), corners.end(), vertices.begin());
}

namespace {

using Distances = std::array<double, ConvexPolygon::capacity>;
enum class Kept { nothing, all, part };

/// The part that a clip keeps. Most keep all or nothing; only a polygon that straddles the plane is rebuilt.
Kept measure(const ConvexPolygon& polygon, const Point3& origin, const Vec3& normal,
             Distances& distance) {
  if (polygon.empty())
    return Kept::nothing;
  bool any_inside = false, any_outside = false;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    distance[k] = glm::dot(normal, polygon.vertices[k] - origin);
    any_inside |= distance[k] > 0.0;
    any_outside |= distance[k] < 0.0;
  }
  return !any_outside ? Kept::all : any_inside ? Kept::part : Kept::nothing;
}

/// The part of positive distance of a polygon that has corners on both sides.
ConvexPolygon positive_part(const ConvexPolygon& polygon, const Distances& distance) {
  const auto next_of = [&polygon](std::size_t k) { return k + 1 < polygon.size ? k + 1 : 0; };
  const auto crosses = [&distance](std::size_t a, std::size_t b) {
    return (distance[a] > 0.0 && distance[b] < 0.0) || (distance[a] < 0.0 && distance[b] > 0.0);
  };

  // A full polygon that would gain a corner stays as it is.
  if (polygon.size == ConvexPolygon::capacity) {
    std::size_t corners = 0;
    for (std::size_t k = 0; k < polygon.size; ++k)
      corners += (distance[k] >= 0.0 ? 1U : 0U) + (crosses(k, next_of(k)) ? 1U : 0U);
    if (corners > ConvexPolygon::capacity)
      return polygon;
  }

  ConvexPolygon part;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const std::size_t next = next_of(k);
    if (distance[k] >= 0.0)
      part.push_back(polygon.vertices[k]);
    // An edge that changes sides meets the plane where its distances balance.
    if (crosses(k, next)) {
      const double t = distance[k] / (distance[k] - distance[next]);
      part.push_back(glm::mix(polygon.vertices[k], polygon.vertices[next], t));
    }
  }
  if (part.empty())
    part.size = 0;
  return part;
}

} // namespace

ConvexPolygon clip(const ConvexPolygon& polygon, const Point3& origin, const Vec3& normal) {
  Distances distance;
  switch (measure(polygon, origin, normal, distance)) {
  case Kept::nothing:
    return {};
  case Kept::all:
    return polygon;
  default:
    return positive_part(polygon, distance);
  }
}

void clip_in_place(ConvexPolygon& polygon, const Point3& origin, const Vec3& normal) {
  Distances distance;
  const Kept kept = measure(polygon, origin, normal, distance);
  if (kept == Kept::nothing)
    polygon.size = 0;
  else if (kept == Kept::part)
    polygon = positive_part(polygon, distance);
}

namespace {

/// Corners of a window closer together than this are one: the direction of so short
/// an edge is the rounding of its ends, and a plane through it would cut anywhere.
double shortest_edge(const ConvexPolygon& window, const Point3& apex) {
  double extent = 0.0, magnitude = 0.0;
  for (std::size_t k = 0; k < window.size; ++k) {
    const Vec3 across = glm::abs(window.vertices[k] - window.vertices[0]);
    const Vec3 coordinates = glm::max(glm::abs(window.vertices[k]), glm::abs(apex));
    extent = std::max({extent, across.x, across.y, across.z});
    magnitude = std::max({magnitude, coordinates.x, coordinates.y, coordinates.z});
  }
  return std::max(1e-10 * extent, 100.0 * std::numeric_limits<double>::epsilon() * magnitude);
}

} // namespace

bool is_point(const ConvexPolygon& polygon, const Point3& apex) {
  const double shortest = shortest_edge(polygon, apex);
  for (std::size_t k = 0; k < polygon.size; ++k)
    if (glm::distance(polygon.vertices[k], polygon.vertices[k > 0 ? k - 1 : polygon.size - 1]) >=
        shortest)
      return false;
  return true;
}

ViewCone view_cone(const Point3& apex, const ConvexPolygon& window) {
  ViewCone cone;
  if (window.empty())
    return cone;
  // Seen from the apex the window runs clockwise when its area vector points away from the apex.
  const double side = glm::dot(area_vector(window.span()), window.vertices[0] - apex);
  if (side == 0.0)
    return cone;
  const double shortest = shortest_edge(window, apex);
  Point3 from = window.vertices[window.size - 1];
  for (const Point3& to : window.span()) {
    if (glm::distance(from, to) < shortest)
      continue;
    const Vec3 a = from - apex, b = to - apex;
    from = to;
    cone.push_back(side > 0.0 ? glm::cross(a, b) : glm::cross(b, a));
  }
  return cone;
}

ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex, const ViewCone& cone) {
  if (cone.size == 0)
    return {};
  // Most polygons are outside of a plane, or inside of all: they are copied where one cuts them.
  Distances distance;
  for (std::size_t k = 0; k < cone.size; ++k) {
    const Kept kept = measure(polygon, apex, cone.inward[k], distance);
    if (kept == Kept::nothing)
      return {};
    if (kept == Kept::all)
      continue;
    ConvexPolygon part = positive_part(polygon, distance);
    while (++k < cone.size && !part.empty())
      clip_in_place(part, apex, cone.inward[k]);
    return part;
  }
  return polygon;
}

ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex,
                           const ConvexPolygon& window) {
  return clip_to_cone(polygon, apex, view_cone(apex, window));
}

ConvexPolygon apply(const Isometry& map, const ConvexPolygon& polygon) {
  ConvexPolygon image;
  for (const auto& vertex : polygon.span())
    image.push_back(apply(map, vertex));
  return image;
}

Vec3 area_vector(std::span<const Point3> polygon) {
  Vec3 sum(0.0);
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += glm::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * sum;
}

} // namespace meninas
