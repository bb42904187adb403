// Small surfaces (mesh/small_surfaces.h) on which little depends one by one:
// each takes an eighth of the samples of others.
//
//   - All, where they are several times as many as elements were asked for: a finely
//     tessellated object has about as many samples as its area has in a coarser one.
//   - Faces of lamps, as neon tubes and bulbs have by thousands, of direct light: what they receive
//     and reflect is little beside what they emit. Where a face emits more than 1/64 of all light
//     there are few, and nothing is to be saved.
//
// Rows depend on geometry alone: they are kept for other light (transport/factor_file.h).
// Limit: so the row of a small lamp in a finely tessellated scene has few rays as well,
// and the energy balance, which follows the lamp's light by it, has their noise.
// Vertices take means over small surfaces (field/curves/smoothing_groups.h).
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Whether an element's row has few rays.
bool has_few_rays(const LightScene& light, ElementId element);

/// Whether its direct light has few samples, and vertices between such elements take their mean.
bool needs_few_samples(const LightScene& light, ElementId element);

/// How many elements there are by what they take of rays: those of few samples as an eighth.
std::size_t sampled_elements(const LightScene& light);

/// The number where few are taken of so many.
inline int few_of(int samples, int fewest = 1) {
  return std::min(samples, std::max(fewest, samples / 8));
}

} // namespace meninas
