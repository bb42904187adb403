// Faces that lie on one another in one plane. (Part of report_scene.)
#pragma once

#include "scenes/mesh_oddities.h"

namespace meninas {

/// Faces of different materials that lie in one plane and overlap with the same side up (or either,
/// where one of the two has two sides), but do not have the same corners:
/// which of them a ray meets is a matter of rounding. Counted by the faces of the first node
/// that something of the second lies on. At least that many in a scene where all overlap.
CountByNodes overlapping_faces(const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
