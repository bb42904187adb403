// The two steps of find_surfaces, for who changes triangles between them.
#pragma once

#include "scenes/surfaces/surfaces.h"

namespace meninas {

/// Surfaces and patches alone: there are no planes, and every plane class is none.
SurfaceModel find_patches(const Scene& scene);

/// Adds the plane classes: surfaces whose vertices are all within tolerance of one plane, whichever
/// way they face, are of one class.
void find_plane_classes(const Scene& scene, SurfaceModel& model);

} // namespace meninas
