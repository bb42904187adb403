#include "radiosity/expected_memory.h"

#include "radiosity/field/refine_direct.h"
#include "radiosity/light/row_cache.h"
#include "scenes/materials/image_size.h"

#include <algorithm>

namespace meninas {

namespace {

std::uint64_t whole(double bytes) { return static_cast<std::uint64_t>(bytes); }

/// Never fewer than a scene of few polygons has: every side of a patch has an element at least.
double expected_elements(const SceneSizes& scene, const PassOneChoice& choice) {
  const MeshSettings mesh = pass_one_settings(choice).mesh;
  const double by_size = mesh.element_size > 0.0
                             ? scene.area / (mesh.element_size * mesh.element_size)
                             : mesh.target_elements;
  // Cells of a side are never larger than asked for, which rounds their number up:
  // by half where sides are a few elements wide.
  return std::min(1.5 * by_size, static_cast<double>(mesh.max_elements)) +
         static_cast<double>(scene.sides);
}

} // namespace

SceneSizes sizes_of(const Scene& scene, std::optional<LampGrouping> lamps) {
  // Decoded, an image is four floats a pixel, and a third as much again in coarser copies.
  constexpr double texel = 16.0 * 4.0 / 3.0;
  SceneSizes sizes{.vertices = scene.vertices.size(),
                   .attributes = scene.attributes.size(),
                   .triangles = scene.triangles.size()};
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
  if (lamps)
    sizes.lamps = find_lamps(scene, *lamps).size();
  return sizes;
}

std::uint64_t scene_memory(const SceneSizes& scene, const PassOneChoice& choice) {
  constexpr double per_vertex = 2 * sizeof(Vertex), per_attributes = 2 * sizeof(VertexAttributes),
                   per_triangle = 1500.0, per_element = 300.0;
  // Nodes divide elements at shadows.
  const double elements = expected_elements(scene, choice);
  const double at_shadows = mesh_cut(choice) == MeshCut::hierarchical
                                ? double(max_at_shadows(static_cast<std::size_t>(elements)))
                                : 0.0;
  return whole(per_vertex * static_cast<double>(scene.vertices) +
               per_attributes * static_cast<double>(scene.attributes) +
               per_triangle * static_cast<double>(scene.triangles) +
               per_element * (elements + at_shadows)) +
         scene.texture_bytes;
}

/// Entries of a row of the transport, at most.
static double row_entries(const PassOneChoice& choice, double elements) {
  const PassOneSettings pass_one = pass_one_settings(choice);
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

/// Rows of the transport, at most: of a hierarchical mesh the first receivers,
/// and those that the light asks for, which are hardly more with finer elements.
static double rows_of(const SceneSizes& scene, const PassOneChoice& choice, double elements) {
  if (mesh_cut(choice) == MeshCut::uniform)
    return elements;
  constexpr double of_a_side = 32.0, of_elements = 1.0 / 16.0;
  return std::min(elements, of_a_side * static_cast<double>(scene.sides) + of_elements * elements);
}

std::uint64_t solve_memory(const SceneSizes& scene, const PassOneChoice& choice) {
  const double elements = expected_elements(scene, choice);
  // Column and up to three bands, and room to grow.
  constexpr double per_entry = 20.0, per_element = 600.0;
  double bytes = rows_of(scene, choice, elements) * per_entry * row_entries(choice, elements) +
                 elements * per_element;
  // At vertices and elements; 250 to 270 were measured of 4 to 64 lamps.
  constexpr double per_element_and_lamp = 270.0;
  if (choice.lamps)
    bytes += per_element_and_lamp * elements * static_cast<double>(scene.lamps);
  if (choice.solver == SolverMethod::direct) {
    const double unknowns = rows_of(scene, choice, elements);
    bytes +=
        4.0 * sizeof(double) * unknowns * unknowns; // the factors of three channels and a matrix
  }
  if (mesh_cut(choice) == MeshCut::hierarchical) // what rays of vertices have met
    bytes +=
        double(sizeof(ElementHit)) *
        std::min<double>(max_cached_rays, elements * pass_one_settings(choice).form_factors.rays);
  return whole(bytes);
}

} // namespace meninas
