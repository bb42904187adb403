// Plates of glass that lie on something: panes.
//
// A slab of glass on a mirror or on a print is a solid of two large faces a thickness t apart and
// of rims. Rays refracted at its faces leave it as they entered, moved by less than t, so the
// slab is to light what a pane is, whose light is known in closed form where that of solids is
// looked for by rays (radiosity/light/glass_light.h). A body of solid glass is replaced by a pane in
// the place of its one large face if
//   the two large faces lie in two parallel planes and are 4/5 of its surface,
//   t is at most 1/50 of the root of the area of one, and
//   something that is not glass, parallel to the other and at most t behind it, is behind 9/10 of
//   that, and in front of the one is no such thing.
// One way through the pane leaves of light what two faces' base colours and the way through the
// slab leave: base_color^2 a(1.1 t), with a of scenes/materials/glass.h. Ways at the angles to which glass
// refracts are t to 1.34 t long, so of glass of which a way t takes a tenth the error is 2 %.
// Where a way takes more than two thirds in a band the slab stays what it is.
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// The nodes whose plates have been replaced, in the order of nodes.
std::vector<NodeId> plates_to_panes(Scene& scene);

} // namespace meninas
