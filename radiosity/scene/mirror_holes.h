// Holes of cut-out mirrors and panes: what meets its mirror in a hole is not reflected.
//
// Mirror-world windows ignore holes, and shadow rays miss them because a leg is never blocked in the plane
// where it ends. So each segment is tested at every point where a leg ends on a mirror.
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Whether there is any of the mirror, and no hole, at a point of its plane.
bool is_solid_at(const LightScene& light, MirrorId mirror, const Point3& x);

/// Whether a folded segment to a point of a world meets one of its mirrors in a hole.
bool meets_hole(const LightScene& light, WorldId world, std::span<const Leg> legs);

} // namespace meninas
