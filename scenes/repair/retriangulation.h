// Flat surfaces of slivers, triangulated anew.
//
// A disc comes as a fan, a floor with holes as long ears. Light depends on the surface,
// not on its triangles: an element is about as long as wide, so a patch takes
//
//   W = L^2 / 2 of a triangle with longest edge L,   W = a b of a quad with sides a and b
//
// times 1 / size^2 of them. Where eight patches of a surface or more take more than three times its
// area A, sum W > 3 A, its triangles are replaced by those of a Delaunay triangulation with vertices
// inside (plane_mesh.h), if that takes less than 0.6 of it.
//
// Kept to the bit: every edge of the outline and of holes, with its vertices, so that nothing opens
// at a neighbour; material, node and front of the surface. New vertices lie in its plane.
// Texture coordinates and vertex colours, where the material uses them, have to be one affine
// function over the surface, which the new vertices then take; other surfaces are left alone.
// So are lamps, mirrors and glass, which have no elements, surfaces of several nodes, and those beyond
// the detail of the scene (precision.h).
#pragma once

#include "scenes/surfaces/surfaces.h"

namespace meninas {

/// Whether any surface has been triangulated anew: `surfaces`, those of the scene, are then out of
/// date. Triangles keep their order, new ones of a surface stand where its first one stood.
bool retriangulate_slivers(Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
