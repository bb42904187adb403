// Mirrors and panes of which alphaMode MASK takes parts away (mirror_holes.h).
#pragma once

#include "mirror/mirrors.h"
#include "scenes/rays/ray_scene.h"

#include <array>
#include <vector>

namespace meninas {

/// The mirrors that the front and the back of a triangle belong to.
std::array<MirrorId, 2> mirrors_of(const SurfaceModel& surfaces, const MirrorSet& mirrors,
                                   TriangleId triangle);

/// By MirrorId, 1 where some of it may be cut out; empty where nothing of any is.
std::vector<std::uint8_t> cut_out_mirrors(const SurfaceModel& surfaces, const RayScene& rays,
                                          const MirrorSet& mirrors);

} // namespace meninas
