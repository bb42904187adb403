// Small surfaces (mesh/small_surfaces.h) on which little depends one by one:
// each takes an eighth of the samples of others.
//
//   - Faces of lamps, as neon tubes and bulbs have by thousands: what they receive and reflect is
//     little beside what they emit. One that emits more than 1/64 of all light is followed as others
//     are: the energy balance depends on its row.
//   - All, where they are several times as many as elements were asked for: a finely
//     tessellated object has as many samples as its area has in a coarser one.
//
// Errors of single ones cancel over their neighbours, as vertices take means over them
// (field/smoothing_groups.h). Those of a plane are one surface before they come here.
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

bool needs_few_samples(const LightScene& light, ElementId element);

/// A number of samples, of which that element needs an eighth or all; at least `fewest`.
inline int samples_of(const LightScene& light, ElementId element, int samples, int fewest = 1) {
  return needs_few_samples(light, element) ? std::min(samples, std::max(fewest, samples / 8))
                                           : samples;
}

} // namespace meninas
