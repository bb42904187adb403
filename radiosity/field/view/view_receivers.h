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

/// Whether light is received over a curve, by its normal.
inline bool is_on_curve(const Receiver& receiver) { return receiver.plane_class == none<PlaneId>; }

/// Where a vertex is: x = x(u, v) of its patch, metres.
Point3 place_of(const LightScene& light, const LatticeCells& cells, const LatticeVertex& vertex);

/// At a vertex. On a border or beside an object it is moved inwards by 2 % of the way to the middle of its
/// cell, at least four times the scene's tolerance.
Receiver receiver_of(const LightScene& light, const LatticeCells& cells,
                     const LatticeVertex& vertex);

} // namespace meninas
