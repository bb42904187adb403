// Lights that are flat, shine evenly from one side, and are nothing else: EXT_lights_area.
//
//   L = radiance from the side it shines to, 0 from behind     W/m^2/sr
//   power = pi A L                                             W
//
// Such a light takes up and blocks none, and the eye does not see it by itself; what reflects shows it.
#pragma once

#include "scenes/scene.h"

#include <optional>

namespace meninas {

/// m^2.
double area_of(const AreaLight& light);

/// Where a ray meets the side that shines: so many lengths of `direction` from `origin`. Precondition:
/// the direction is not zero.
std::optional<double> lit_crossing(const AreaLight& light, const Point3& origin,
                                   const Vec3& direction);

} // namespace meninas
