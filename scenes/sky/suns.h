// Small suns of a map of radiance, which become directional light.
//
//   cap   L_c = 100 times the mean luminance of min(L, L_c), W/m^2/sr: a fixed point
//   sun   texels that touch one another with L > L_c, if all lie within 3 degrees of their mean direction
//   E     sum of (L - L_c-scaled) dw of its texels, towards their mean weighted so, W/m^2
//
// One of 512 rays that meets 100 times the mean adds 20 % to what the others bring: more would be
// a spot in the picture. Limits: the 16 brightest; what is larger stays in the map.
#pragma once

#include "scenes/sky/radiance_map.h"

namespace meninas {

/// Fills `suns` and `without_suns` from `texels`.
void find_suns(RadianceMap& map);

} // namespace meninas
