// Things that touch: which of two that lie in one plane light meets first.
//
// Modellers lay a pane with the same corners on a print, glue a slab of glass to its silver, put
// a lamp into the plane of the ceiling and a spot light at the ceiling's height. Each looks right
// where pictures are drawn from one side to the other; of rays it would be rounding that decides.
// So they are put where they are meant to be, by a distance that cannot be seen and that rounding
// cannot bridge: t = 1e-5 of the radius of the scene's detail (precision.h), or several times its
// tolerance if that is more.
//
//   A face of glass within t of one that is not, and overlapping it in its plane, is put 2 t
//   before it: to where the rest of its body is, a sheet before the front of what has one side, and
//   otherwise to where its own front looks. The body is all of one node and material; what of it
//   lies in that plane goes along.
//   A face that emits likewise before one that does neither emit nor let light through, if the two
//   can be seen from the same side; a sheet that emits to one side, to that side.
//   A point or spot light within t of a face that is not glass is put 2 t before it: a spot to the
//   side to which it shines, a point light before the front of a face of one side. Before a face of
//   two sides it stays on its side, if rounding does not make it, otherwise it comes to its front.
//   An area light in the plane of such a face, and over it, is put 2 t before it, the way it shines.
//   A point light there shines into the half-space before the face alone (a spot of 90 degrees): the
//   spot at its foot is too small to be seen. The face reflects there rho of half of the light, which comes from the
//   same place and is added to the light's own (punctual_light.h). Limits: not from a textured face, nor
//   what luminaires send backwards, nor in an edge of two faces.
#pragma once

#include "scenes/scene.h"

#include <string>

namespace meninas {

/// The nodes whose faces have been moved, each once, in the order of nodes.
std::vector<NodeId> separate_touching(Scene& scene);

/// The names of the lights that have been moved, in their order.
std::vector<std::string> settle_lights(Scene& scene);

} // namespace meninas
