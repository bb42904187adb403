// The first step of find_surfaces, for who changes triangles before the second (plane_classes.h).
#pragma once

#include "scenes/surfaces/surfaces.h"

namespace meninas {

/// Surfaces and patches alone: there are no planes, and every plane class is none.
SurfaceModel find_patches(const Scene& scene);

} // namespace meninas
