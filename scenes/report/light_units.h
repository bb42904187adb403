// Point and spot lights that are out of proportion with what glows, as one exporter writes them:
// lights in candela, 683 lm/W, and emission as the radiance that it was.
//
// If all their light stayed in the scene, its surfaces would have the mean irradiance
//
//   H = sum_k Omega_k I_k / A        W/m^2; Omega 4 pi or that of a spot's cone, A the area of all
//
// Rooms are lit with 1 to 20 W/m^2, and a lamp is brighter than a white wall beside it. Units are
// mixed where H is over 100 W/m^2, a tenth of full sunlight, and yet all that glows is darker than a
// white wall in that light, L < H / pi. In scenes that are photometric all through, lamps have
// thousands of cd/m^2. Suns are not counted: by day a lamp may well be darker than the wall.
#pragma once

#include "scenes/scene.h"

#include <optional>
#include <string>

namespace meninas {

/// A sentence about it, where units are mixed.
std::optional<std::string> describe_mixed_units(const Scene& scene);

} // namespace meninas
