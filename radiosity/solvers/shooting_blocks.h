// Blocks of neighbouring elements that shoot together: a patch shoots, elements gather.
//
// A block is the elements of at most 8 x 8 root cells of one quad side,
// or of at most 64 that follow one another on a triangle side:
// so it lies in one plane, and a room has hundreds of shooters.
// Where there are tens of thousands of sides, small ones that follow one another share blocks.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "radiosity/solvers/shooting.h"

namespace meninas {

/// Unknowns are elements, measures their exposed areas in m^2:
/// `exposed` is the exposed share by ElementId.
Shooters make_shooting_blocks(const ElementMesh& mesh, const std::vector<float>& exposed);

} // namespace meninas
