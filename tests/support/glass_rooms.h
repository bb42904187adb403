// Glass for tests, and a room with it.
#pragma once

#include "tests/support/scene_builder.h"

namespace meninas::test {

/// A pane, clear but for its tint.
Material glass(Rgb tint, double ior = 1.5);

/// The surface of a solid.
Material solid_glass(Rgb tint, double ior = 1.5);

/// Fresnel's reflectance of one face for unpolarised light from outside, written after Snell's law:
/// by the angles of incidence and refraction.
double face_reflectance(double ior, double cosine);

/// What a pane without tint passes.
double pane_transmittance(double ior, double cosine);

/// One black texel, and a white one to its right.
Texture half_black();

/// Lays the image over the quad that was added last,
/// its lower left corner first, by both sets of coordinates.
void lay_texture(Scene& scene);

/// A closed room of two metres whose walls are black and glow, each in a colour of its own.
Scene glowing_room();

/// A closed room of two metres with a lamp, and a green pane that stands before the wall z = 0.
Scene glazed_room();

/// The same, but the left half of the pane is opaque:
/// by a texture of one pane, or as a pane of its own.
enum class Halves { by_texture, of_their_own };
Scene half_glazed_room(Halves halves);

} // namespace meninas::test
