// From watts to lumens: what linear RGB is to the eye.
//
//   E_v = K (0.2126 R + 0.7152 G + 0.0722 B)      K in lm/W, 683 unless chosen; weights of Rec.709
//
// gives lux (lm/m^2) of irradiance in W/m^2 and cd/m^2 of radiance in W/m^2/sr.
#pragma once

#include "scenes/types.h"

namespace meninas {

/// The luminance of a colour, Rec.709: also its weight where one number has to stand for it.
inline double luminance_of(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

inline double luminous(double efficacy, const Rgb& radiometric) {
  return efficacy * luminance_of(radiometric);
}

} // namespace meninas
