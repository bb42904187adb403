#include "runs/steering/memory.h"

#include "radiosity/light/row_cache.h"
#include "radiosity/field/refine_direct.h"
#include "scenes/errors.h"
#include "scenes/materials/image_size.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace meninas {
namespace {

/// Never fewer than a scene of few polygons has: every side of a patch has an element at least.
double expected_elements(const SceneSizes& scene, const RunSettings& settings) {
  const MeshSettings mesh = two_pass_settings(settings).pass_one.mesh;
  const double by_size = mesh.element_size > 0.0
                             ? scene.area / (mesh.element_size * mesh.element_size)
                             : mesh.target_elements;
  // Cells of a side are never larger than asked for, which rounds their number up:
  // by half where sides are a few elements wide.
  return std::min(1.5 * by_size, static_cast<double>(mesh.max_elements)) +
         static_cast<double>(scene.sides);
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

SceneSizes sizes_of(const Scene& scene) {
  // Decoded, an image is four floats a pixel, and a third as much again in coarser copies.
  constexpr double texel = 16.0 * 4.0 / 3.0;
  SceneSizes sizes{.vertices = scene.vertices.size(), .triangles = scene.triangles.size()};
  for (const Texture& texture : scene.textures) {
    const auto size = image_size(
        {reinterpret_cast<const unsigned char*>(texture.encoded.data()), texture.encoded.size()});
    const double pixels = size ? double(size->width) * size->height : 0.0;
    sizes.texture_bytes += texture.encoded.size() + whole(texel * pixels);
  }
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto triangle = static_cast<TriangleId>(t);
    const std::size_t sides = material_of(scene, triangle).double_sided ? 2 : 1;
    sizes.sides += sides;
    sizes.area += double(sides) * glm::length(area_vector(corners(scene, triangle)));
  }
  return sizes;
}

std::uint64_t scene_memory(const SceneSizes& scene, const RunSettings& settings) {
  constexpr double per_vertex = 2 * sizeof(Vertex), per_triangle = 1500.0, per_element = 300.0;
  // How many an adaptive field has is not known beforehand;
  // it is made to have fewer than a mesh of one size, and more where it begins with more.
  // Nodes divide elements at shadows.
  const QualityPreset preset = preset_of(settings.quality);
  const double roots = settings.elements ? *settings.elements : preset.root_elements;
  const double field_elements = settings.adaptive == WithAdaptivity::yes
                                    ? preset.target_elements * roots / preset.root_elements
                                    : 0.0;
  const double elements = expected_elements(scene, settings);
  const double at_shadows = settings.solver == SolverMethod::hierarchical
                                ? double(max_at_shadows(static_cast<std::size_t>(elements)))
                                : 0.0;
  return whole(per_vertex * static_cast<double>(scene.vertices) +
               per_triangle * static_cast<double>(scene.triangles) +
               per_element * (elements + field_elements + at_shadows)) +
         scene.texture_bytes;
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

/// Rows of the transport, at most: of the hierarchical solver the first receivers,
/// and those that the light asks for, which are hardly more with finer elements.
static double rows_of(const SceneSizes& scene, const RunSettings& settings, double elements) {
  if (settings.solver != SolverMethod::hierarchical)
    return elements;
  constexpr double of_a_side = 32.0, of_elements = 1.0 / 16.0;
  return std::min(elements, of_a_side * static_cast<double>(scene.sides) + of_elements * elements);
}

std::uint64_t solve_memory(const SceneSizes& scene, const RunSettings& settings) {
  const double elements = expected_elements(scene, settings);
  // Column and up to three bands, and room to grow.
  constexpr double per_entry = 20.0, per_element = 600.0;
  double bytes = rows_of(scene, settings, elements) * per_entry * row_entries(settings, elements) +
                 elements * per_element;
  if (settings.solver == SolverMethod::direct) {
    bytes +=
        4.0 * sizeof(double) * elements * elements; // the factors of three channels and a matrix
  }
  if (settings.solver == SolverMethod::hierarchical) // what rays of vertices have met
    bytes += double(sizeof(ElementHit)) *
             std::min<double>(max_cached_rays,
                              elements * two_pass_settings(settings).pass_one.form_factors.rays);
  return whole(bytes);
}

std::uint64_t view_memory(const SceneSizes& scene, const RunSettings& settings, PictureSize size) {
  const double pixels = double(size.width) * size.height;
  const bool layers = settings.layers == WithLayers::yes;
  const bool reference = settings.mode == PictureMode::reference;
  // A plane of floats while it is rendered, once more while it is encoded, and the encoded file.
  const double planes = 1.0 + (layers ? 9.0 : 0.0) + (reference ? 8.0 : 0.0) +
                        static_cast<double>(settings.features.size());
  constexpr double per_plane = 3.0 * sizeof(glm::vec3), per_picture = 4e6;
  const double own_scene = reference ? static_cast<double>(scene_memory(scene, settings)) : 0.0;
  return whole(per_picture + per_plane * planes * pixels + own_scene);
}

std::uint64_t expected_memory(const SceneSizes& scene, const RunSettings& settings,
                              const std::optional<PictureSize>& size) {
  // The parts are meant not to be exceeded; what the program needs before any scene is not in them.
  constexpr double of_bound = 0.65, program = 60e6;
  // A reference does not solve.
  const bool solves = settings.mode != PictureMode::reference;
  const std::uint64_t bound = (solves ? scene_memory(scene, settings) : 0) +
                              (solves ? solve_memory(scene, settings) : 0) +
                              (size ? view_memory(scene, settings, *size) : 0);
  return whole(program + of_bound * static_cast<double>(bound));
}

std::uint64_t memory_limit(const RunSettings& settings) {
  return settings.memory_limit.value_or(available_memory_bytes());
}

void check_memory(const Scene& scene, const RunSettings& settings,
                  const std::optional<PictureSize>& size) {
  const std::uint64_t needed = expected_memory(sizes_of(scene), settings, size);
  const std::uint64_t limit = memory_limit(settings);
  if (needed > limit) {
    throw OutputError(scene.file, "memory",
                      fmt::format("needs about {}, more than the limit of {}: larger elements, "
                                  "fewer --rays or a smaller picture need less",
                                  readable_bytes(needed), readable_bytes(limit)));
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
