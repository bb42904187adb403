// Sides that face the inside of a closed body (closed_bodies.h), where no light comes.
//
// Exporters write furniture double-sided. Inside of a cupboard there is nothing to see,
// but its inner sides would have elements of their own, and the floor under a box, dark
// as it is, would count with the lit floor beside its foot (contact_mask.h knows it by the black
// backs of single-sided bodies). Where a closed body has no light in it,
// its double-sided triangles are therefore what single-sided ones would be.
//
// A lamp is in a body where one of its triangles has a corner inside or crosses the shell. A point x is inside if
//
//   w(x) = 1/4pi sum of the signed solid angles of the body's triangles > 1/2      (dimensionless, closed_bodies.h)
//
// Light comes through translucent surfaces: bodies that have some are left as they are.
//
// Limits: bodies that cross themselves, as some of their triangles tell, are left as they are,
// and so are those with so many lamps within their bounds that asking would take long:
// no side is enclosed that is not known to be.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas {

/// By TriangleId, then front and back: 1 where the side is enclosed.
using EnclosedSides = std::vector<std::array<std::uint8_t, 2>>;

EnclosedSides find_enclosed_sides(const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
