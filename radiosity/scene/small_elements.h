// Small surfaces (mesh/small_surfaces.h) whose individual error hardly matters:
// each gets n / 8 of the n samples of other elements.
//
//   - All, where they are several times as many as elements were asked for: a finely
//     tessellated object has about as many samples as its area has in a coarser one.
//   - Faces of lamps, as neon tubes and bulbs have by thousands, of direct light: they receive and reflect
//     little beside what they emit. This holds for A E <= P / 64 with P the power of all emitters (W, the
//     brightest channel). There are few faces above that bound, and nothing to be saved.
//
// Rows depend on geometry alone: they are kept for other light (transport/factor_file.h).
// Limit: so the row of a small lamp in a finely tessellated scene has few rays as well,
// and the energy balance, which follows the lamp's light by it, has their noise.
// Vertices take means over small surfaces (field/curves/smoothing_groups.h).
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Whether an element's row has few rays.
bool has_reduced_rays(const LightScene& light, ElementId element);

/// Whether its direct light has few samples, and vertices between such elements take their mean.
bool has_reduced_samples(const LightScene& light, ElementId element);

/// The number of elements in units of full samples: elements with reduced samples count as an eighth.
std::size_t sampled_elements(const LightScene& light);

/// The number where few are taken of so many.
inline int reduced_count(int samples, int fewest = 1) {
  return std::min(samples, std::max(fewest, samples / 8));
}

} // namespace meninas
