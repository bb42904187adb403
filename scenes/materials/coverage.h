// Alpha as coverage (Porter and Duff 1984): of a surface of alpha a the share a is there, and
// through the rest light goes straight on, neither bent nor coloured:
//
//   f = a f_surface,   T = 1 - a,   L_e = a L_e,surface
//
// That is what glTF's alphaMode BLEND shows, whatever lies behind. Light that a surface throws
// through its own openings is none, so the shares add up: a white surface in a white room is white.
#pragma once

#include "scenes/materials/bsdf_parameters.h"
#include "scenes/materials/texture_pixels.h"

namespace meninas {

/// a at a point; 1 of a material that is not blended.
double coverage(const Material& material, const MaterialPoint& point);

/// The radiance that a point shows by itself: what it emits, or of an unlit surface its colour.
Rgb shown_radiance(const Material& material, const MaterialPoint& point);

/// The share of partly open texels among those that are there at all, at this alpha factor.
/// It is small where alpha is an outline, as of leaves.
double partly_covered_share(const TexturePixels& pixels, double alpha);

} // namespace meninas
