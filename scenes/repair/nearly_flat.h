// Surfaces that are flat but for the rounding of their vertices are made flat.
//
// A mirror whose vertices are off its plane by e turns a facet of width s by e / s, and what that
// facet reflects onto a wall at distance d moves by 2 d e / s: a tenth of a millimetre breaks the
// image of a lamp into shreds. The plane itself is known to about e over the whole width w, which
// moves the image by 2 d e / w. So the vertices are moved onto their plane, by e at most: rays,
// mirror worlds, windows and the reference then see one and the same exact plane.
//
// A smooth part is a set of triangles of one material across whose edges the normal turns by at
// most 20 degrees. The part, or what grows in it around its widest triangles, is flat if its
// vertices are within e of their plane of least squares and one of these holds:
//   stated  e is what the file says that it rounds by, and the surface ends where it ends by
//           edges or holes rather than by leaving the plane;
//   unseen  e <= 1e-4 w, and no facet turns by more than 0.005: light moves by 0.1 % of its way at
//           the most, however the vertices came off;
//   noise   e <= 5e-4 w, and the heights of neighbouring vertices know nothing of one another:
//           I = (sum over edges h_i h_j / edges) / (sum h_i^2 / vertices) <= 1/2, Moran 1950.
// A curved mirror fails all three: its sagitta a^2 / 8 R is larger, it goes on beyond the tolerance
// in the same bend, and I is near 1. Ripples and hammered glass keep their shape for the same
// reason. Surfaces that are flat to their tolerance (precision.h) are not touched.
//
// A vertex of several planes moves to their common point, line or plane, by the least way.
#pragma once

#include "scenes/scene.h"

#include <span>

namespace meninas {

struct Flattening {
  std::size_t surfaces = 0;
  std::size_t vertices = 0; ///< that were moved
  double farthest = 0.0;    ///< metres
};

/// `half_steps` by vertex: half the step of positions that the file rounds, in metres.
Flattening flatten_nearly_flat(Scene& scene, std::span<const float> half_steps = {});

} // namespace meninas
