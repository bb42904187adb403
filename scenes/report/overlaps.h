// Faces that lie on one another in one plane.
#pragma once

#include "scenes/report/mesh_oddities.h"

namespace meninas {

/// Faces of different materials that lie in one plane and overlap with the same side up (or either,
/// where one of the two has two sides), but do not have the same corners:
/// which of them a ray meets is a matter of rounding. Counted by the faces of the first node
/// that something of the second lies on. At least that many in a scene where all overlap.
CountByNodes overlapping_faces(const Scene& scene, const SurfaceModel& surfaces);

/// Whether two triangles, seen along a normal, have more in common than a strip of that depth.
bool overlap_along(const Direction& normal, const std::array<Point3, 3>& a,
                   const std::array<Point3, 3>& b, double depth);

} // namespace meninas
