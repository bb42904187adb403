// The expected memory of pass one, bytes, before any of its work.
//
//   scene    vertices, triangles, textures; ray structures, mesh and field of about N elements
//   solve    rows x entries of a row, at most min(rays, N), and what finds them
//
// Bytes = counts x measured sizes (docs/notes/batch.md): an upper bound for common scenes, and within a
// factor of about two for large ones.
#pragma once

#include "radiosity/pass_one_settings.h"

#include <cstdint>

namespace meninas {

/// The counts of a scene that its memory depends on.
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

/// The memory of solving besides that, bytes: the transport, unless the solver keeps none, and the workspaces that
/// find it; where lamps are told apart, the light of each.
std::uint64_t solve_memory(const SceneSizes& scene, const PassOneChoice& choice);

} // namespace meninas
