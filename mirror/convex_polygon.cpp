#include "mirror/convex_polygon.h"

#include <algorithm>

namespace meninas {

ConvexPolygon::ConvexPolygon(std::span<const Point3> corners) : size(corners.size()) {
  expects(corners.size() <= capacity, "a convex polygon holds at most its capacity of corners");
  std::copy(corners.begin(), corners.end(), vertices.begin());
}

ConvexPolygon& ConvexPolygon::operator=(const ConvexPolygon& other) {
  size = other.size;
  std::copy_n(other.vertices.begin(), size, vertices.begin());
  return *this;
}

ConvexPolygon clip(const ConvexPolygon& polygon, const Point3& origin, const Vec3& normal) {
  if (polygon.empty()) return {};

  // Most clips keep all or nothing; only a polygon that straddles the plane is rebuilt.
  std::array<double, ConvexPolygon::capacity> distance;
  bool any_inside = false, any_outside = false;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    distance[k] = glm::dot(normal, polygon.vertices[k] - origin);
    any_inside |= distance[k] > 0.0;
    any_outside |= distance[k] < 0.0;
  }
  if (!any_outside) return polygon;
  if (!any_inside) return {};

  ConvexPolygon part;
  for (std::size_t k = 0; k < polygon.size && part.size < ConvexPolygon::capacity; ++k) {
    const std::size_t next = k + 1 < polygon.size ? k + 1 : 0;
    if (distance[k] >= 0.0) part.push_back(polygon.vertices[k]);
    // An edge that changes sides meets the plane where its distances balance.
    const bool crosses = (distance[k] > 0.0 && distance[next] < 0.0) || (distance[k] < 0.0 && distance[next] > 0.0);
    if (crosses && part.size < ConvexPolygon::capacity) {
      const double t = distance[k] / (distance[k] - distance[next]);
      part.push_back(glm::mix(polygon.vertices[k], polygon.vertices[next], t));
    }
  }
  return part.empty() ? ConvexPolygon{} : part;
}

ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex, const ConvexPolygon& window) {
  if (window.empty()) return {};

  // Seen from the apex the window runs clockwise when its area vector points away from the apex.
  const double side = glm::dot(area_vector(window.span()), window.vertices[0] - apex);
  if (side == 0.0) return {};
  ConvexPolygon part = polygon;
  for (std::size_t k = 0; k < window.size && !part.empty(); ++k) {
    const Vec3 a = window.vertices[k] - apex;
    const Vec3 b = window.vertices[k + 1 < window.size ? k + 1 : 0] - apex;
    const Vec3 inward = side > 0.0 ? glm::cross(a, b) : glm::cross(b, a);
    part = clip(part, apex, inward);
  }
  return part;
}

Vec3 area_vector(std::span<const Point3> polygon) {
  Vec3 sum(0.0);
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += glm::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * sum;
}

} // namespace meninas
