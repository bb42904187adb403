// Holes in the surfaces of a scene, as flat convex polygons.
//
// An edge that only one face has is loose; where several shorter edges lie on a long one, so is every
// piece of it that is so. Loose edges that form a closed line in one plane are the outline of a surface
// or of a hole: who asks finds out which. Lines that are not convex are cut into triangles by their ears
// (Meisters 1975), convex ones of more than 32 corners into parts. Left out: lines that are not flat, that touch
// themselves, that have more than 512 corners and are not convex, and all of scenes with more than 4096 loose edges.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas {

/// Corners in order, metres, of either orientation.
std::vector<std::vector<Point3>> open_polygons(const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
