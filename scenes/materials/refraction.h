// Solid glass: what its surface does to light besides reflecting and passing its shares (glass.h).
//
// Behind one face light goes on as Snell's law says, sin = sin' ior,
// and from inside not at all beyond the angle of total reflection: then R = 1.
// Radiance inside is stated divided by n^2, which is its value once it has come out again.
// A face that is met from inside is one whose ior is the inverse.
// Solids are smooth, however rough they are said to be:
// one direction each is reflected and refracted.
#pragma once

#include "scenes/materials/bsdf_parameters.h"

namespace meninas {

/// The same surface as it is from its back: of a solid, from inside.
Bsdf from_behind(Bsdf bsdf);

/// The direction from which what goes on towards `out`, above the face in its local frame,
/// has come through it: -out through a pane. None beyond total reflection.
std::optional<Direction> direction_behind(const Glass& glass, const Direction& out);

} // namespace meninas
