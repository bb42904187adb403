// Bodies that light cannot enter, as far as their surface goes.
//
// A body is what opaque triangles form that share edges two by two. It is closed if every edge
// is shared, or if the others make plane loops that lie on something opaque all over,
// as those of a box without a bottom do on a floor.
//
// Limits: loops are those of up to 4,096 edges that are star-shaped about one of their corners,
// and what covers them lies in their plane to the tolerance of the scene: a body without a bottom
// that is sunk into a floor is open. At most twenty million loop-triangle comparisons are made, in the
// order of the triangles; bodies with loops beyond that count as open.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <span>
#include <vector>

namespace meninas {

using TriangleCorners = std::array<Point3, 3>;

struct ClosedBody {
  std::vector<TriangleId> triangles;
  std::vector<std::uint8_t> looks_in; ///< by place: 1 where the front of a triangle does
  std::vector<TriangleCorners> shell; ///< these and what closes loops, all fronts outwards
};

/// The closed bodies with at least one triangle in `wanted`, by TriangleId.
std::vector<ClosedBody> find_closed_bodies(const Scene& scene, const SurfaceModel& surfaces,
                                           const std::vector<std::uint8_t>& wanted);

/// The winding number of a body about a point, dimensionless, 1 inside and 0 outside of one that does not cross
/// itself:  w(x) = 1/4pi sum of the signed solid angles of its triangles (scenes/surfaces/shells.h).
double winding_number(const std::vector<TriangleCorners>& shell, const Point3& x);

Bounds bounds_of(std::span<const TriangleCorners> triangles);
bool overlap(const Bounds& a, const Bounds& b, double tolerance = 0.0);

} // namespace meninas
