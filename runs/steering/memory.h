// The memory a run may use, the expected memory of its parts, and the memory it uses now, bytes.
//
// The parts are radiosity/expected_memory.h and raytrace/error/picture_cost.h; a run is their sum.
#pragma once

#include "radiosity/expected_memory.h"
#include "runs/run_settings.h"

#include <cstdint>

namespace meninas {

/// The bytes that the machine, or the control group of this process, allows.
std::uint64_t available_memory_bytes();

/// The resident bytes of this process now.
std::uint64_t resident_memory_bytes();

/// A picture under way and its encoding; a reference needs its own scene too.
std::uint64_t view_memory(const SceneSizes& scene, const RunSettings& settings, PictureSize size);

/// The expected peak of a run's resident memory, bytes:
/// solving the scene, and a picture of that size if there is one.
/// 1.4 times what was measured for an interior of 450,620 elements (1.1 GiB), solved by rays.
/// `parts`: of the rows of a uniform mesh only one of so many is made.
std::uint64_t expected_memory(const SceneSizes& scene, const RunSettings& settings,
                              const std::optional<PictureSize>& size, std::uint64_t parts = 1);

/// The memory limit of a run by these settings, bytes: as asked, else all there is.
std::uint64_t memory_limit(const RunSettings& settings);

/// Throws OutputError when a run of this scene is expected to take more than it may,
/// before it takes it.
void check_memory(const Scene& scene, const RunSettings& settings,
                  const std::optional<PictureSize>& size, std::uint64_t parts = 1);

/// "3.2 GiB"
std::string readable_bytes(std::uint64_t bytes);

} // namespace meninas
