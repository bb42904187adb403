// Where light that falls on a curved surface is looked for: on the curve (scenes/shading_normal.h),
// unless something stands between it and the chord, and a hair above.
//
// Rays from there leave no plane. Rays that go below a hollow surface meet it at once, because the
// flat triangle is nearer to the light inside than the curve is.
#pragma once

#include "scenes/rays/ray_scene.h"
#include "scenes/scene.h"
#include "scenes/surfaces/surfaces.h"

namespace meninas {

/// The origin over the point of a curved triangle, on the side that was met.
Point3 curved_origin(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                     TriangleId triangle, Vec2 barycentric, bool front);

} // namespace meninas
