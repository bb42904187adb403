// Light of KHR_lights_punctual and EXT_lights_ies at a point.
//
//   point, spot   E = I f(theta) / d^2 at normal incidence, I in W/sr, f the fall from the inner to the outer cone of a spot
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
