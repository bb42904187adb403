// The sun's light through the air, after Preetham, Shirley and Smits 1999, appendix A.1 (Iqbal 1983):
//
//   E = w integral of L_0(l) exp(-m (0.008735 l^-4.08 + b l^-1.3 + 0.35 k_o(l))) cmf(l) dl     l in micrometres
//   m = 1 / (cos t + 0.15 (93.885 - t)^-1.253)     t in degrees from the zenith;   b = 0.04608 T - 0.04586
//
// for Rayleigh's scattering, haze of turbidity T and ozone; w = 6.80e-5 sr is the solid angle of
// the sun. Colour matching by the fit of Wyman, Sloan and Shirley 2013. Result: irradiance at normal incidence
// in W/m^2, linear Rec.709, whose luminance times 683 is the illuminance in lux. Water vapour and
// oxygen, which absorb beyond 690 nm, are left out: below 0.3 % of the luminance.
#pragma once

#include "scenes/types.h"

namespace meninas {

/// Zenith angle in radians; 0 where the sun is not above the horizon.
Rgb sun_irradiance(double turbidity, double zenith_angle);

} // namespace meninas
