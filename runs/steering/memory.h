// How much memory a run may have, how much its parts are going to need, and what it has now.
// In bytes.
//
// Estimates come from counts known before the work (triangles, elements, rays, pixels) times
// sizes measured (docs/notes/batch.md); they are meant to be exceeded by nothing that is common,
// so that a limit holds, and to be within a factor of about two for what is large.
#pragma once

#include "runs/run_settings.h"
#include "scenes/scene.h"

#include <cstdint>

namespace meninas {

/// What the machine, or the control group of this process, allows.
std::uint64_t available_memory_bytes();

/// What this process has resident now.
std::uint64_t resident_memory_bytes();

/// What is counted of a scene.
struct SceneSizes {
  std::size_t vertices = 0, triangles = 0;
  std::size_t sides = 0;         ///< of triangles: two of what is double-sided
  std::size_t texture_bytes = 0; ///< encoded and decoded
  double area = 0.0;             ///< m^2, of all sides
};
SceneSizes sizes_of(const Scene& scene);

/// A scene with its light, ready for views: geometry, textures, ray structures, mesh and field.
std::uint64_t scene_memory(const SceneSizes& scene, const RunSettings& settings);

/// What solving needs beyond that: the transport, unless the solver keeps none, and what finds it.
std::uint64_t solve_memory(const SceneSizes& scene, const RunSettings& settings);

/// A picture under way and its encoding; a reference needs its own scene too.
std::uint64_t view_memory(const SceneSizes& scene, const RunSettings& settings, PictureSize size);

/// What one run is likely to have resident at most:
/// solving the scene, and a picture of that size if there is one.
/// 1.4 times what was measured for an interior of 450,620 elements (1.1 GiB), solved by rays.
std::uint64_t expected_memory(const SceneSizes& scene, const RunSettings& settings,
                              const std::optional<PictureSize>& size);

/// What a run by these settings may have: as asked, else all there is.
std::uint64_t memory_limit(const RunSettings& settings);

/// Throws OutputError when a run of this scene is expected to take more than it may,
/// before it takes it.
void check_memory(const Scene& scene, const RunSettings& settings,
                  const std::optional<PictureSize>& size);

/// "3.2 GiB"
std::string readable_bytes(std::uint64_t bytes);

} // namespace meninas
