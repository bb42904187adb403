// From the cells below the elements to the tables that a field is looked up in.
//
// An element that is divided gives way, in the descent from (u, v) to the element, to the descent through its cells.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/field/view/lattice_cells.h"

namespace meninas {

/// The lookup of the first `roots` cells, which are elements, and of those below. Their vertices are numbered from
/// `first_vertex` on. Elements without cells stay what they are.
FieldCells cell_lookup(const ElementMesh& mesh, const LatticeCells& all, std::size_t roots,
                       std::size_t first_vertex);

} // namespace meninas
