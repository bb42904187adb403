// Direct irradiance:
// the light of emitters and of their images in the mirror worlds, by their form factors.
//
//   D(x) = sum_w tau_w sum_e E_e F(x, T_w e clipped) V(x, w, e)
//
// F is Lambert's closed form for a point and a polygon, V the visible fraction:
// low-discrepancy points on the clipped image, weighted by the cosines and distance
// of the form factor they stand for, each tested along every leg of the folded path.
// Few points where all agree, more in penumbrae; panes and coats on the legs take their
// part of each, and what emitters send by way of solids is added (glass_light.h).
// Punctual lights, and their images, add I f cos / d^2 where the one segment to them is free.
#pragma once

#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/lighting.h"
#include "radiosity/transport/form_factors.h"

namespace meninas {

/// The kernel of the form factor at a point y of an image with that normal, per area and times pi, 1/m^2:
/// both cosines over the square of the distance.
double form_factor_share(const Receiver& receiver, const Direction& normal, const Point3& y);
inline double form_factor_share(const Receiver& receiver, const VirtualLight& image, const Point3& y) {
  return form_factor_share(receiver, image.normal, y);
}

/// The irradiance from the images in `workspace.lights`, W/m^2.
ArrivingLight images_irradiance(const Lighting& light, const Receiver& receiver,
                                const DirectSettings& settings, std::uint32_t seed,
                                DirectWorkspace& workspace);

ArrivingLight direct_irradiance(const Lighting& light, const Receiver& receiver,
                                const DirectSettings& settings, std::uint32_t seed,
                                DirectWorkspace& workspace);

/// The irradiance, W/m^2, from the images of emitters at the point last asked for if nothing blocked them.
Rgb unblocked_irradiance(const Lighting& light, const DirectWorkspace& workspace);

} // namespace meninas
