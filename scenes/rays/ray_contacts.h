// Rules for a ray and the triangles that touch its origin.
//
// A point on a surface is only known to the rounding of its coordinates,
// so near an edge it may lie a hair behind the adjoining wall.
// Whether a ray from there meets that wall is not decided by the rounded point but by the surfaces:
// the point lies on that side of the wall W where its own surface P is,
// and W stands in the way where it rises above P.
// Where P crosses a W of two sides at a small angle and the point is nearer to W than rounding, either may be
// before the other. A ray met P, which is therefore before W, unless the ray goes on through P: W stands in the way
// of rays through glass. The ends of a leg were not met: they are where they are said to be.
// All lengths are in the frame of the ray scene.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <optional>
#include <span>
#include <vector>

namespace meninas {

enum class Sidedness { single, both };

struct ContactTriangle {
  TriangleId triangle = none<TriangleId>;
  PlaneId plane = none<PlaneId>;
  Sidedness sidedness = Sidedness::single;
  bool glass = false;
  std::array<Point3, 3> corners{};
};

/// The triangles within the reach of a point, those of the plane it lies on and the others.
struct Contacts {
  std::vector<ContactTriangle> own;
  std::vector<ContactTriangle> others;
};

/// A point that leaves a plane of the given normal along a direction:
/// of unit length for a ray, up to the end for a leg.
struct Departure {
  Point3 origin;
  Vec3 direction;
  Direction plane_normal;
  bool is_leg = false;
};

/// The weights of the second and third corner of the point of the triangle nearest to x.
Vec2 nearest_barycentric(const std::array<Point3, 3>& corners, const Point3& x);
double distance_to(const std::array<Point3, 3>& corners, const Point3& x);
/// Whether the distance is at most `reach`;
/// soon known where the plane of the triangle is further away.
bool is_within(const std::array<Point3, 3>& corners, const Point3& x, double reach);

/// The touching triangle that a departing ray runs into at once, if any: the one met most squarely.
/// Lengths below `noise` count as zero.
std::optional<ContactTriangle> blocking_contact(const Contacts& contacts,
                                                const Departure& departure, double noise);

} // namespace meninas
