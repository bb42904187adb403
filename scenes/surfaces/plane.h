// A plane by its unit normal and its distance from the origin: dot(normal, x) = offset.
#pragma once

#include "scenes/types.h"

namespace meninas {

/// { x : dot(normal, x) = offset }
struct Plane {
  Direction normal{0.0, 0.0, 1.0};
  double offset = 0.0;
};

inline double signed_distance(const Plane& plane, const Point3& x) {
  return glm::dot(plane.normal, x) - plane.offset;
}
/// The point of the plane next to the origin of space.
inline Point3 origin_of(const Plane& plane) { return plane.offset * plane.normal; }

} // namespace meninas
