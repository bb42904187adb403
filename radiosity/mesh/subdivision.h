// Finer elements where they are wanted:
// cells of the forest divided, neighbours kept alike, no cracks.
//
// Elements are divided into four by the middles of their edges.
// Neighbours differ by one level at most, also across the edges that patches of one surface share:
// an element is divided as well where one of the two smaller ones along its edge is, and where on
// its edge, at a quarter of the length, there is a vertex of another patch (a restricted quadtree,
// Von Herzen and Barr 1987). A vertex left in the middle of a larger element's edge
// hangs: it takes the mean of the edge's ends.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <span>

namespace meninas {

/// Whether a leaf may be divided: not at the last level,
/// nor slivers hardly wider than the distance at which two points are the same.
bool is_divisible(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshCell& leaf);

/// The mesh with the elements marked 1 divided, as far as they may be, and those that have to
/// follow. `marked` by ElementId.
ElementMesh divide_elements(const ElementMesh& mesh, const SurfaceModel& surfaces,
                            std::span<const std::uint8_t> marked);

/// The forest as a list: by CellId 1 where the cell is divided, 0 for leaves.
/// It and the roots are all that a mesh is made from.
std::vector<std::uint8_t> division_of(const ElementMesh& mesh);

/// The mesh of that division. `roots` is the same mesh, divided or not.
/// Precondition: `is_division_of` holds.
ElementMesh divided_mesh(const ElementMesh& roots, const SurfaceModel& surfaces,
                         std::span<const std::uint8_t> division);

/// Whether a list fits the roots:
/// one entry for every cell it speaks of, 0 or 1, no deeper than `max_levels`.
bool is_division_of(const ElementMesh& roots, std::span<const std::uint8_t> division);

/// By CellId of `from`:
/// the same cell in `to`, a mesh of the same roots that has all cells of `from`.
std::vector<CellId> same_cells(const ElementMesh& from, const ElementMesh& to);

/// By ElementId of `to`, a mesh as above: the weight (dimensionless, at least 0) of the element of `from` that it is
/// part of. In cells with several elements the largest counts for all. `weights` empty: so is the result.
std::vector<float> parts_of(const ElementMesh& from, std::span<const float> weights,
                            const ElementMesh& to);

/// The vertices of an element of one mesh in another that it was divided into, `cell` its cell there:
/// none where it is not known to be the same, as where something stands.
ElementCorners same_corners(const ElementMesh& from, ElementId element, const ElementMesh& to,
                            CellId cell);

/// Where a vertex of a mesh is in a coarser one, of which it has all cells: in the element that the
/// vertex's own elements are parts of, though something may stand between it and them.
ElementPoint place_in(const ElementMesh& coarse, const SurfaceModel& surfaces,
                      const ElementMesh& mesh, ElementVertexId vertex);

/// The mean of the ends, f_v = (f_a + f_b) / 2, for all hanging vertices. `values` by ElementVertexId, in any unit.
template <typename Value>
void settle_hanging(const ElementMesh& mesh, std::vector<Value>& values) {
  for (const HangingVertex& h : mesh.hanging)
    values[index(h.vertex)] =
        (values[index(h.end_a)] + values[index(h.end_b)]) * typename Value::value_type(0.5);
}

} // namespace meninas
