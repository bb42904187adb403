// The second step of find_surfaces, after find_patches.
#pragma once

#include "scenes/surfaces/surfaces.h"

namespace meninas {

/// Adds the plane classes: surfaces whose vertices are all within tolerance of one plane, whichever
/// way they face, are of one class.
void find_plane_classes(const Scene& scene, SurfaceModel& model);

} // namespace meninas
