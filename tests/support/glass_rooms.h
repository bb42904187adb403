// Glass for tests, and a room with it.
#pragma once

#include "tests/support/scene_builder.h"

namespace meninas::test {

/// A pane, clear but for its tint.
Material glass(Rgb tint, double ior = 1.5);

/// The surface of a solid.
Material solid_glass(Rgb tint, double ior = 1.5);

/// Fresnel's reflectance of one face for unpolarised light from outside, written after Snell's law: by the angles of incidence and refraction.
double face_reflectance(double ior, double cosine);

/// What a pane without tint passes.
double pane_transmittance(double ior, double cosine);

/// A closed room of two metres with a lamp, and a green pane that stands before the wall z = 0.
Scene glazed_room();

} // namespace meninas::test
