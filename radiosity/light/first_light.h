// Light that no element has scattered yet: the source of eq. 1, S = rho (D + G), and of translucent
// surfaces with what comes through them (transport/translucency.h).
//
//   D   from emitters, punctual and area lights, also by way of enumerated mirror worlds, in closed form (element_light.h)
//   G   emission that the transport's rays have gathered, and the background: pi L for the share of an element's rays that escape
//
// The analytic method gathers all emission itself;
// only punctual and area lights, which are no surfaces, are left to D then.
#pragma once

#include "radiosity/light/element_light.h"
#include "radiosity/transport/translucency.h"

namespace meninas {

struct FirstLight {
  std::vector<Rgb> irradiance, source, reflectance; ///< D + G, S = rho (D + G), rho by ElementId
  std::vector<Rgb> direct;                     ///< D; empty where it is not set apart
  std::vector<Rgb> entering; ///< the part of D + G that no surface emits; empty where there is none
  TranslucentLinks translucent; ///< by ElementId
  LightByLamp by_lamp = {}, direct_by_lamp = {}; ///< D + G and D; empty where light is not told apart
  std::uint64_t shadow_rays = 0;
};

/// The light found by the elements' own rays, by ElementId.
struct FoundByRays {
  std::vector<Rgb> gathered; ///< G, W/m^2
  const std::vector<RowClosure>& closure;
  std::span<const ContactMask> covered;
  std::span<const float> exposed;
  LightByLamp gathered_by_lamp = {};
};

/// D + G of D that has been found.
FirstLight first_light(const LightScene& light, FoundByRays rays, const DirectIrradiance& direct,
                       FormFactorMethod method);

/// D is found here.
FirstLight first_light(const LightScene& light, FoundByRays rays, FormFactorMethod method,
                       const DirectSettings& settings, const Progress& progress);

} // namespace meninas
