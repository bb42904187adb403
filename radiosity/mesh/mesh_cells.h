// The forest of cells under an element mesh: restricted quadtrees (Von Herzen, Barr 1987).
//
// Steps of make_element_mesh() and divide_elements(); who uses a mesh needs neither.
#pragma once

#include "radiosity/mesh/element_mesh.h"

namespace meninas {

/// The root cells of all sides, which know their divisions: in the order of the sides.
void add_root_cells(ElementMesh& mesh);

/// Whether a cell may have a vertex on the border of its patch. There others may have another
/// division, where they would want far more, and may end in the middle of an edge
/// (edge_divisions.h); within a patch neighbours are cells of one forest.
bool is_at_border(const ElementMesh& mesh, const MeshCell& cell);

/// Divides cell number `cell` into four, which are appended.
void divide_cell(ElementMesh& mesh, std::uint32_t cell);

/// Points closer than about this are one vertex, metres.
double vertex_grain(const ElementMesh& mesh, const SurfaceModel& surfaces);

/// The longest edge between corners, metres.
double longest_edge(const ElementMesh& mesh, const ElementCorners& corners);

/// The point (s, t) of a cell.
Point3 point_in(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshCell& cell,
                Vec2 st);

/// A key that keeps the vertices of different surfaces and sides apart.
std::uint64_t surface_side(const ElementMesh& mesh, const SurfaceModel& surfaces,
                           const MeshCell& cell);

} // namespace meninas
