// Details that are too small for rays, whose coordinates are floats, beside the size of the scene.
//
// Gaps narrower than the reach of contacts (ray_scene.cpp) count as closed, and a large face that
// passes the detail at a slant is off its place there by the rounding of its far corners.
// Surfaces closer together than the precision of positions count as one plane. Limit: floats cannot
// do better, so a warning says where this happens.
#pragma once

#include "scenes/rays/ray_scene.h"

namespace meninas {

/// At most one line about surfaces that count as one plane although their own corners,
/// were there nothing else in the scene, would tell them apart.
std::vector<std::string> warnings_of_merged_planes(const Scene& scene,
                                                   const SurfaceModel& surfaces);

/// The same, one line about gaps and one about faces.
std::vector<std::string> warnings_of_mixed_scales(const Scene& scene, const SurfaceModel& surfaces,
                                                  const RayScene& rays);

} // namespace meninas
