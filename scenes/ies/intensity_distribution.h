// Measured intensity distributions of luminaires: I(d), candela, bilinear between the measured angles.
//
// Directions are those of EXT_lights_ies: d in the luminaire's own axes, of unit length, -Z where it aims.
//
//   type C   vertical g = acos(-d_z), from 0 where it aims; horizontal f = atan2(d_y, d_x), about -Z
//   type B   vertical asin(d_x), about the polar axis X; horizontal atan2(-d_y, -d_z), from 0 where it aims
//
// Horizontal angles of type C up to 90 degrees are one quadrant of four alike, up to 180 one of two halves
// alike, from 90 to 270 likewise, and a single one stands for all. Horizontal angles of type B from 0 on
// are one half of two alike. Where nothing was measured it is dark. ANSI/IESNA LM-63-2002, 5.
#pragma once

#include "scenes/types.h"

#include <vector>

namespace meninas {

enum class Photometry { type_c, type_b };

struct IntensityDistribution {
  Photometry photometry = Photometry::type_c;
  std::vector<double> vertical = {}, horizontal = {}; ///< degrees, rising
  std::vector<double> candela = {};                   ///< by horizontal angle, then by vertical angle
};

/// Candela.
double intensity_at(const IntensityDistribution& distribution, const Direction& d);

/// Lumens: the integral of I over all directions, by the middles of 360 x 180 cells; 1e-3 of it off
/// where I jumps between angles that lie a degree apart.
double luminous_flux(const IntensityDistribution& distribution);

} // namespace meninas
