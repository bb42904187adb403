// How many bytes pass one is going to have, before any of its work.
//
//   scene    vertices, triangles, textures; ray structures, mesh and field of about N elements
//   solve    rows x entries of a row, at most min(rays, N), and what finds them
//
// Counts times sizes that were measured (docs/notes/batch.md), meant to be exceeded by nothing that
// is common, and to be within a factor of about two for what is large.
#pragma once

#include "radiosity/pass_one_settings.h"

#include <cstdint>

namespace meninas {

/// What is counted of a scene.
struct SceneSizes {
  std::size_t vertices = 0, attributes = 0, triangles = 0; ///< attributes: Scene::attributes
  std::size_t sides = 0;         ///< of triangles: two of what is double-sided
  std::size_t texture_bytes = 0; ///< encoded and decoded
  double area = 0.0;             ///< m^2, of all sides
  std::size_t lamps = 0;         ///< whose light may be told apart; 0: it is not
};
/// `lamps` counts them, so grouped. The suns of a sky are found later.
SceneSizes sizes_of(const Scene& scene, std::optional<LampGrouping> lamps = std::nullopt);

/// A scene with its light, ready for views: geometry, textures, ray structures, mesh and field.
std::uint64_t scene_memory(const SceneSizes& scene, const PassOneChoice& choice);

/// What solving needs beyond that: the transport, unless the solver keeps none, and what finds it; where
/// lamps are told apart, what each of them sends.
std::uint64_t solve_memory(const SceneSizes& scene, const PassOneChoice& choice);

} // namespace meninas
