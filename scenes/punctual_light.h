// Light of KHR_lights_punctual and EXT_lights_ies at a point.
//
//   point, spot   E = I f(theta) / d^2 at normal incidence, I in W/sr, f the fall from the inner to the outer cone of a spot
//   in a face     E = I (1 + 2 rho cos theta) / d^2, theta from the normal of the face: half of its light, 2 pi I, falls on the
//                 face at its foot, which reflects rho of it by Lambert's law (repair/touching.h)
//   luminaire     E = I g(d) / d^2, g measured (ies/intensity_distribution.h)
//   directional   E = I in W/m^2, from infinitely far
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// Irradiance at normal incidence from a punctual light, in W/m^2, and where its shadow rays end.
struct PunctualSample {
  Point3 position;
  Rgb irradiance{0.0};
};
/// `reach` is farther than anything in the scene.
PunctualSample punctual_sample(const PunctualLight& light, const Point3& x, double reach);

} // namespace meninas
