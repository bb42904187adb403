// Direct irradiance of elements:
// the mean over an element of what emitters and their images send (direct_irradiance.h),
//
//   D_i = 1/A_i integral over element i of D(x)
//
// at the points of a low-discrepancy sequence over the element,
// which share their shadow rays (shared_light.h).
#pragma once

#include "radiosity/transport/hemisphere_rays.h"
#include "radiosity/light/shared_light.h"

namespace meninas {

/// A mean over an element, and the part of it that no face sent but punctual and area lights, W/m^2.
struct MeanLight {
  Rgb total{0.0}, entering{0.0};
};

/// The mean over the exposed part of an element: points are doubled until it settles. Punctual lights
/// where a narrow spot meets the element in part: 256 points of each such part (spot_parts.h).
MeanLight direct_irradiance(const Lighting& light, ElementId element, ContactMask covered,
                            const DirectSettings& settings, SharedLightWorkspace& workspace);

/// `mean(k, workspace)` of so many areas, by all threads, and the shadow rays they took.
struct MeansOfAreas {
  std::vector<MeanLight> light;
  LightByLamp by_lamp = {}; ///< in proportion to what lamps send there
  std::uint64_t shadow_rays = 0;
};
MeansOfAreas
means_of_areas(std::size_t count, std::size_t lamps,
               const std::function<MeanLight(std::size_t, SharedLightWorkspace&)>& mean,
               const Progress& progress);

struct DirectIrradiance {
  std::vector<Rgb> irradiance; ///< by ElementId, the mean over the element
  std::vector<Rgb>
      entering; ///< the part of it that punctual and area lights sent; empty where there are none
  std::vector<std::uint8_t>
      shared; ///< 1 where it is that of the corners (hierarchical/node_light.h); empty: nowhere
  LightByLamp by_lamp = {}; ///< of the irradiance; empty where it is not told apart
  std::uint64_t shadow_rays = 0;
};

/// `covered` by ElementId (hemisphere_rays.h):
/// the mean is over the exposed part. Empty: all is exposed.
DirectIrradiance direct_irradiance(const Lighting& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress = {});

} // namespace meninas
