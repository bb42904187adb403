#include "runs/batch/memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace meninas {
namespace {

/// Never fewer than a scene of few polygons has: every patch has an element at least.
double expected_elements(const SceneFacts& facts, const RunSettings& settings) {
  const MeshSettings mesh = two_pass_settings(settings).pass_one.mesh;
  const double by_size = mesh.element_size > 0.0
                             ? facts.area / (mesh.element_size * mesh.element_size)
                             : mesh.target_elements;
  // Cells of a side are never larger than asked for, which rounds their number up: by half where sides are a few elements wide.
  return std::min(1.5 * by_size, static_cast<double>(mesh.max_elements)) +
         static_cast<double>(facts.triangles);
}

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

std::uint64_t scene_memory(const SceneFacts& facts, const RunSettings& settings) {
  constexpr double per_vertex = 2 * sizeof(Vertex), per_triangle = 1500.0, per_element = 300.0;
  // How many an adaptive field has is not known beforehand; it is made to have fewer than a mesh of one size.
  const double field_elements =
      settings.adaptive == WithAdaptivity::yes ? preset_of(settings.quality).target_elements : 0.0;
  return whole(per_vertex * static_cast<double>(facts.vertices) +
               per_triangle * static_cast<double>(facts.triangles) +
               per_element * (expected_elements(facts, settings) + field_elements)) +
         3 * facts.texture_bytes;
}

/// Entries of a row of the transport, at most.
static double row_entries(const RunSettings& settings, double elements) {
  const PassOneSettings pass_one = two_pass_settings(settings).pass_one;
  const FormFactorSettings& factors = pass_one.form_factors;
  const double resolution = factors.hemicube_resolution;
  switch (factors.method) {
  case FormFactorMethod::rays:
    // Shots are traced when they are needed, and forgotten.
    return shoots_rays(pass_one, static_cast<std::size_t>(elements))
               ? 0.0
               : std::min<double>(factors.rays, elements);
  case FormFactorMethod::hemicube: // cells of the top and the four half sides
    return std::min(3.0 * resolution * resolution, elements);
  case FormFactorMethod::analytic:
    break;
  }
  return elements;
}

std::uint64_t solve_memory(const SceneFacts& facts, const RunSettings& settings) {
  const double elements = expected_elements(facts, settings);
  // Column and up to three bands, and room to grow.
  constexpr double per_entry = 20.0, per_element = 600.0;
  double bytes = elements * (per_entry * row_entries(settings, elements) + per_element);
  if (settings.solver == SolverMethod::direct) {
    bytes +=
        4.0 * sizeof(double) * elements * elements; // the factors of three channels and a matrix
  }
  return whole(bytes);
}

std::uint64_t view_memory(const BatchPicture& picture) {
  const RunSettings& settings = picture.request.settings;
  const double pixels = double(picture.size.width) * picture.size.height;
  const bool layers = settings.layers == WithLayers::yes;
  const bool reference = settings.mode == PictureMode::reference;
  // A plane of floats while it is rendered, once more while it is encoded, and the encoded file.
  const double planes = 1.0 + (layers ? 9.0 : 0.0) + (reference ? 8.0 : 0.0) +
                        static_cast<double>(settings.features.size());
  constexpr double per_plane = 3.0 * sizeof(glm::vec3), per_picture = 4e6;
  const double own_scene =
      reference ? static_cast<double>(scene_memory(*picture.facts, settings)) : 0.0;
  return whole(per_picture + per_plane * planes * pixels + own_scene);
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
