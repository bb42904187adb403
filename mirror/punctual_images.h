// Punctual lights and their images in the mirror worlds, as seen from one point.
//
// The image of a light at y in the world w stands at T_w y and shines
// as the light does on T_w^-1 x: a reflection keeps lengths and angles. With E of punctual_light.h,
//
//   E_w(x) = max(0, n . (T_w y - x) / |T_w y - x|) E(T_w^-1 x),      W/m^2, tau_w and visibility aside.
//
// It is seen from x where the segment to it passes the visible part of the last window
// (virtual_lights.h), behind that mirror. Directional lights stand at a distance beyond the scene.
// Images beyond the tree are not found: nothing else finds light without extent.
#pragma once

#include "mirror/virtual_lights.h"
#include "scenes/punctual_light.h"

namespace meninas {

struct PunctualImage {
  WorldId world = real_world;
  Point3 position;     ///< in unfolded space
  Rgb irradiance{0.0}; ///< at the observer's plane, blockers and mirrors' reflectances aside
  std::uint32_t light = 0;  ///< its number among the lights
};

/// Clears and fills `images`: those that shine on the observer's side,
/// light by light in every seen world. `reach` as of punctual_sample().
void punctual_images(const WorldTree& tree, std::span<const PunctualLight> lights,
                     const SeenWorlds& seen, const Observer& observer, double reach,
                     std::vector<PunctualImage>& images);

} // namespace meninas
