#include "mirror/reflection.h"

namespace meninas {

Point3 reflect_point(const Plane& mirror, const Point3& x) {
  return x - 2.0 * signed_distance(mirror, x) * mirror.normal;
}

Direction reflect_direction(const Plane& mirror, const Direction& d) {
  return d - 2.0 * glm::dot(mirror.normal, d) * mirror.normal;
}

Plane reflect_plane(const Plane& mirror, const Plane& plane) {
  const Direction normal = reflect_direction(mirror, plane.normal);
  const Point3 on_plane = reflect_point(mirror, origin_of(plane));
  return {normal, glm::dot(normal, on_plane)};
}

Plane apply(const Isometry& map, const Plane& plane) {
  const Direction normal = apply_direction(map, plane.normal);
  return {normal, glm::dot(normal, apply(map, origin_of(plane)))};
}

Isometry compose_reflection(const Isometry& outer, const Plane& mirror) {
  // R x = (1 - 2 n n^T) x + 2 d n.
  const glm::dmat3 householder =
      glm::dmat3(1.0) - 2.0 * glm::outerProduct(mirror.normal, mirror.normal);
  const Vec3 shift = 2.0 * mirror.offset * mirror.normal;
  return {outer.linear * householder, outer.linear * shift + outer.translation};
}

} // namespace meninas
