// Meshes that pass through each other. (Part of report_scene.)
#pragma once

#include "scenes/report/mesh_oddities.h"
#include "scenes/rays/ray_scene.h"

namespace meninas {

/// The number of sides of faces, drawn a little inwards, that first meet a face with their ends on either side of
/// it, farther off than rounding and a thousandth of their length explain, and not at its rim:
/// faces that merely touch or stand on others are not counted. By nodes, the lower id first.
CountByNodes crossings(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays);

} // namespace meninas
