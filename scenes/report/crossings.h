// Meshes that pass through each other. (Part of report_scene.)
#pragma once

#include "scenes/report/mesh_oddities.h"
#include "scenes/rays/ray_scene.h"

namespace meninas {

/// How many sides of faces, drawn a little inwards, first meet a face that their ends lie on either
/// side of, farther off than rounding and a thousandth of their length explain, and not at its rim:
/// what merely touches or stands on something is not counted. By nodes, the lower id first.
CountByNodes crossings(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays);

} // namespace meninas
