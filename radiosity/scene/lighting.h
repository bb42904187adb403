// A scene and the emitters it is lit by: its own lamps, or bright elements in their place.
//
//   D(x) = sum over worlds w, emitters e of  tau_w E_e F(x, T_w e) V(x, w, e)        W/m^2
//
// Direct light is computed from a Lighting (light/direct_irradiance.h): the scene says what blocks,
// the emitters what sends, the tree of worlds by way of which mirrors. Refers to objects that outlive it.
#pragma once

#include "radiosity/scene/light_scene.h"

#include <algorithm>

namespace meninas {

struct Lighting {
  const LightScene& scene;
  const WorldTree& worlds; ///< in which emitters are looked at: the scene's, or the first of them
  std::span<const Emitter> emitters;
  const LightTree& emitter_tree; ///< over the emitters
  std::span<const PunctualLight> punctual;
  std::span<const std::uint8_t>
      direct_sides; ///< by SideId: 1 where the emitters are its emission; empty where they are no side's
  const LampShares* lamps = nullptr; ///< of the emitters; null: light is not told apart

  /// By its own lamps.
  Lighting(const LightScene& own)
      : scene(own), worlds(own.worlds), emitters(own.emitters), emitter_tree(own.emitter_tree),
        punctual(own.punctual), direct_sides(own.direct_sides),
        lamps(own.lamps ? &own.lamps : nullptr) {}

  /// By other emitters alone, which no side's emission is.
  Lighting(const LightScene& lit, const WorldTree& seen_in, std::span<const Emitter> others,
           const LightTree& tree, std::span<const PunctualLight> points = {})
      : scene(lit), worlds(seen_in), emitters(others), emitter_tree(tree), punctual(points) {}
};

/// Whether some of its light comes from no face and no sky: of punctual or area lights.
inline bool sends_from_no_face(const Lighting& light) {
  return !light.punctual.empty() || std::ranges::any_of(light.emitters, [](const Emitter& emitter) {
    return emitter.area_light != no_area_light;
  });
}

} // namespace meninas
