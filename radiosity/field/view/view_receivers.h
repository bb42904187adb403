// Where direct light is received for one view: the place, normal and plane at which D is computed, in metres,
// for the points that are seen and for the vertices of the cells that they are in.
#pragma once

#include "radiosity/field/view/lattice_cells.h"
#include "radiosity/field/view/seen_cells.h"
#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/light_scene.h"

namespace meninas {

/// At a point of the view.
Receiver receiver_of(const LightScene& light, const SeenPoint& point);

/// At a vertex: on borders, and beside what stands in or beside an element, a little inside: 0.02 of the way to the
/// middle of the cell that it was made for, but by no less than four times what is told apart.
Receiver receiver_of(const LightScene& light, const LatticeCells& cells,
                     const LatticeVertex& vertex);

} // namespace meninas
