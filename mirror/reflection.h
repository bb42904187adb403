// Reflection in a plane { x : n.x = d }:  x' = x - 2 (n.x - d) n,  and its composition.
//
// A mirror world w = (m1 ... mk) is the room seen by way of m1 first and mk last.
// Its images lie at T_w y with T_w = R_m1 R_m2 ...
// R_mk, so that the straight segment from x to T_w y unfolds into the path x, m1, ..., mk, y.
// Points and offsets d in metres, directions of unit length.
#pragma once

#include "scenes/surfaces/surfaces.h"

namespace meninas {

Point3 reflect_point(const Plane& mirror, const Point3& x);
Direction reflect_direction(const Plane& mirror, const Direction& d);
Plane reflect_plane(const Plane& mirror, const Plane& plane);

/// An isometry x -> linear x + translation, a product of reflections.
struct Isometry {
  glm::dmat3 linear{1.0};
  Vec3 translation{0.0};
};

inline Point3 apply(const Isometry& map, const Point3& x) {
  return map.linear * x + map.translation;
}
inline Direction apply_direction(const Isometry& map, const Direction& d) { return map.linear * d; }
Plane apply(const Isometry& map, const Plane& plane);

/// First the reflection in `mirror`, then `outer`:  outer R_mirror.
Isometry compose_reflection(const Isometry& outer, const Plane& mirror);

} // namespace meninas
