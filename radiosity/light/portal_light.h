// The radiance of the sky that shadow rays find beyond openings (radiosity/scene/sky_portals.h).
//
//   E shown = pi L(d),   d the direction in which the last leg of a ray leaves
//
// as a factor (dimensionless) of the opening's own E = pi L_0, W/m^2: exactly 1 where the sky is even, 0 where the
// ray leaves by an opening behind this one.
#pragma once

#include "mirror/emitters.h"
#include "radiosity/light/virtual_light_visibility.h"

namespace meninas {

/// Whether the opening's rays have to be weighed one by one.
inline bool is_uneven(const LightScene& light, const Emitter& emitter) {
  return emitter.shows_sky() && (light.sky != nullptr || light.portals.size() > 1);
}

/// Where a shadow ray from x by a point y of an emitter's image ends: there, or of an opening
/// beyond the scene, in no plane.
Leg shadow_leg(const LightScene& light, const Emitter& emitter, Leg to_emitter);

/// The irradiance shown by an unblocked segment of shadow_leg() over the emitter's own E, dimensionless; 0 where the
/// ray leaves by another opening behind this one, which has its light.
Rgb shown_by(const LightScene& light, const Emitter& emitter, const FoldedSegment& segment);

} // namespace meninas
