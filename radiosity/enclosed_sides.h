// Sides that face the inside of a closed body, where no light comes.
//
// Exporters write furniture double-sided. Inside of a cupboard there is nothing to see,
// but its inner sides would have elements of their own, and the floor under a box, dark
// as it is, would count with the lit floor beside its foot (covered_cells.h knows it by the black
// backs of single-sided bodies). Where a closed body has no light in it,
// its double-sided triangles are therefore what single-sided ones would be.
//
// A body is what opaque triangles form that share edges two by two. It is closed if every edge
// is shared, or if the others make plane loops that lie on something opaque,
// as those of a box without a bottom do on a floor: no light passes it.
// Inside is where the winding number of its triangles and of the loops' fans,
//
//   w(x) = 1/4pi sum of their signed solid angles from x      (van Oosterom and Strackee 1983),
//
// is 1. A lamp is inside where one of fifteen points of a triangle of it is.
//
// Limits: loops count as covered if rays from half a per cent of their size above, at 256 places
// and beside the edges, meet something as near; openings between these are not seen,
// and bodies that go deeper into what they stand on are closed only if they have a bottom.
#pragma once

#include "scenes/ray_scene.h"

#include <vector>

namespace meninas {

/// By TriangleId, then front and back: 1 where the side is enclosed.
using EnclosedSides = std::vector<std::array<std::uint8_t, 2>>;

EnclosedSides find_enclosed_sides(const Scene& scene, const SurfaceModel& surfaces,
                                  const RayScene& rays);

} // namespace meninas
