// The element mesh of a scene: elements of about one size on every surface, or as many as are asked for.
//
// Leaves are cut along the contact segments of what stands on them (contact_segments.h, cut_cells.h).
#pragma once

#include "radiosity/mesh/element_mesh.h"

namespace meninas {

/// Sides marked in `dark` get no elements; empty: all are meshed. No cell is divided; those are cut
/// on which something stands.
ElementMesh make_element_mesh(const Scene& scene, const SurfaceModel& surfaces,
                              const MeshSettings& settings = {}, const DarkSides& dark = {});

} // namespace meninas
