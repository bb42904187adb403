// How much memory a batch may have, how much its parts are going to need, and what it has now. In bytes.
//
// Estimates come from counts known before the work (triangles, elements, rays, pixels) times sizes measured (ARCHITECTURE.md); they are
// meant to be exceeded by nothing that is common, so that a limit holds, and to be within a factor of about two for what is large.
#pragma once

#include "runs/batch/batch_plan.h"

#include <cstdint>

namespace meninas {

/// What the machine, or the control group of this process, allows.
std::uint64_t available_memory_bytes();

/// What this process has resident now.
std::uint64_t resident_memory_bytes();

/// A scene with its light, ready for views: geometry, textures, ray structures, mesh and field.
std::uint64_t scene_memory(const SceneFacts& facts, const RunSettings& settings);

/// What solving needs beyond that: the transport, unless the solver keeps none, and what finds it.
std::uint64_t solve_memory(const SceneFacts& facts, const RunSettings& settings);

/// A picture under way and its encoding; a reference needs its own scene too.
std::uint64_t view_memory(const BatchPicture& picture);

/// "3.2 GiB"
std::string readable_bytes(std::uint64_t bytes);

} // namespace meninas
