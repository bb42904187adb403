// Holes of cut-out mirrors and panes: what meets its mirror in a hole is not reflected.
//
// Windows of mirror worlds know nothing of holes, and shadow rays do not find them,
// as a leg is not blocked in the plane it ends in.
// So every segment is asked at the points in which its legs end on mirrors.
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Whether there is any of the mirror, and no hole, at a point of its plane.
bool is_solid_at(const LightScene& light, MirrorId mirror, const Point3& x);

/// Whether a folded segment to a point of a world meets one of its mirrors in a hole.
bool meets_hole(const LightScene& light, WorldId world, std::span<const Leg> legs);

} // namespace meninas
