#include "runs/steering/memory.h"

#include "raytrace/error/picture_cost.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace meninas {
namespace {

std::uint64_t whole(double bytes) { return static_cast<std::uint64_t>(bytes); }

} // namespace

std::uint64_t available_memory_bytes() {
  auto bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
               static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::ifstream group("/sys/fs/cgroup/memory.max"); // "max" where there is no limit
  if (std::uint64_t limit = 0; group >> limit) {
    bytes = std::min(bytes, limit);
  }
  return bytes;
}

std::uint64_t resident_memory_bytes() {
  std::ifstream status("/proc/self/statm");
  std::uint64_t size = 0, resident = 0;
  status >> size >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t view_memory(const SceneSizes& scene, const RunSettings& settings, PictureSize size) {
  const double pixels = double(size.width) * size.height;
  const bool layers = settings.layers == WithLayers::yes;
  const bool reference = settings.mode == PictureMode::reference;
  const double planes = 1.0 + (layers ? 9.0 : 0.0) + (reference ? 8.0 : 0.0) +
                        static_cast<double>(settings.features.size());
  const double own_scene = reference ? static_cast<double>(scene_memory(scene, settings)) : 0.0;
  const DiffuseTerm term = reference ? DiffuseTerm::interpolated : diffuse_term(settings);
  return whole(expected_picture_bytes(pixels, planes, term) + own_scene);
}

std::uint64_t expected_memory(const SceneSizes& scene, const RunSettings& settings,
                              const std::optional<PictureSize>& size, std::uint64_t parts) {
  // The parts are meant not to be exceeded; what the program needs before any scene is not in them.
  constexpr double of_bound = 0.65, program = 60e6;
  // A reference does not solve.
  const bool solves = settings.mode != PictureMode::reference;
  const std::uint64_t bound = (solves ? scene_memory(scene, settings) : 0) +
                              (solves ? solve_memory(scene, settings) / parts : 0) +
                              (size ? view_memory(scene, settings, *size) : 0);
  return whole(program + of_bound * static_cast<double>(bound));
}

std::uint64_t memory_limit(const RunSettings& settings) {
  return settings.memory_limit.value_or(available_memory_bytes());
}

void check_memory(const Scene& scene, const RunSettings& asked,
                  const std::optional<PictureSize>& size, std::uint64_t parts) {
  RunSettings settings = asked;
  if (settings.lamp_layers)
    settings.lamps = LampGrouping::node;
  const std::uint64_t needed = expected_memory(sizes_of(scene, settings.lamps), settings, size, parts);
  const std::uint64_t limit = memory_limit(settings);
  if (needed > limit) {
    throw OutputError(scene.file, "memory",
                      fmt::format("needs about {}, more than the limit of {}: larger elements, "
                                  "fewer --rays{} or a smaller picture need less",
                                  readable_bytes(needed), readable_bytes(limit),
                                  settings.lamps ? ", fewer lamps apart" : ""));
  }
}

std::string readable_bytes(std::uint64_t bytes) {
  constexpr std::array units{"B", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024.0 && unit + 1 < units.size(); ++unit) {
    value /= 1024.0;
  }
  return fmt::format("{:.3g} {}", value, units[unit]);
}

} // namespace meninas
