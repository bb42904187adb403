// Sides that no light can reach, which therefore need no elements:
// the outer faces of a double-sided room, say, and the inner ones of a double-sided cupboard.
//
// The latter are found by the bodies that they are part of (enclosed_sides.h).
// Any other side of a double-sided patch is dark when every one of its 256 probe rays,
// spread over the side and its hemisphere, escapes the scene, to where there is no background,
// and no emitter or punctual light in front of it can be seen from any of eight probe points:
// then H = D = 0 W/m^2. Independent rays miss a share p of the hemisphere with probability (1 - p)^256.
// Single-sided fronts are not probed:
// they are there to be lit. Emitting sides, and those of translucent surfaces, are never dark.
#pragma once

#include "scenes/rays/ray_scene.h"

#include <vector>

namespace meninas {

/// By PatchId, then front and back: 1 where the side is dark.
using DarkSides = std::vector<std::array<std::uint8_t, 2>>;

DarkSides find_dark_sides(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays);

} // namespace meninas
