// Glass: what a pane, or one face of a solid, reflects and passes of light.
//
// F is Fresnel's reflectance of a face for unpolarised light,
// ior to 1, brought to the F0 and F90 of KHR_materials_specular:
//
//   F(c) = F0 + (F90 - F0) (f(c) - f(1)) / (1 - f(1)),   f(c) = (r_s^2 + r_p^2) / 2
//
// which is f(c) itself unless that extension says otherwise, and 0 at every angle for an ior of 1.
// (Schlick's approximation is not.) Inside of a pane light goes to and fro between its faces;
// t is what one way through leaves of it, by the base colour.
// The sums of all that comes out again are geometric series:
//
//   both faces   T = (1 - F)^2 t / (1 - F^2 t^2),   R = F + F t T
//   one face     T = (1 - F) t,                     R = F
//
// So R + T = 1 where t = 1: clear glass absorbs nothing. Below a thin film F is in part that of the
// film (thin_film.h) times F90, at the cosine of the angle in the air.
// A pane is thin: light leaves it where it enters.
#pragma once

#include "scenes/material.h"

namespace meninas {

enum class GlassFaces {
  both, ///< a pane
  one,  ///< the surface of a solid
  none  ///< an opening: R = 0, T = 1
};

struct Glass {
  double ior = 1.5; ///< 0 stands for F0 = 1
  Rgb f0{0.04};
  double f90 = 1.0;
  Rgb tint{1.0}; ///< t
  GlassFaces faces = GlassFaces::both;
  ThinFilm film{}; ///< of whole panes one on either face
};

struct GlassShares {
  Rgb reflected{0.0}, passed{0.0};
};

/// At this cosine of the angle outside.
GlassShares glass_shares(const Glass& glass, double cosine);

/// The means over the hemisphere, weighted by the cosine.
GlassShares mean_glass_shares(const Glass& glass);

/// Fresnel's reflectance for unpolarised light that comes from outside (ratio = ior)
/// or from inside (ratio = 1 / ior); 1 beyond the angle of total reflection.
double fresnel(double ratio, double cosine);

/// The transmittance of some metres in a solid:
/// attenuation_color^(metres / attenuation_distance).
Rgb attenuation(const Material& material, double metres);

} // namespace meninas
