#include "scenes/smooth_surfaces.h"

#include "scenes/lobes.h"
#include "scenes/surfaces.h"
#include "scenes/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace meninas {

namespace {

bool may_be_smooth(const Material& material) {
  return !is_glass(material) && !is_emitter(material) && material.alpha_mode != AlphaMode::mask;
}

bool is_smooth_metal(const Material& material) {
  return is_glossy(material) && material.roughness <= smooth_metal_roughness &&
         !is_textured(material) && may_be_smooth(material);
}

/// Pictures of the paint below a coat change nothing about it.
bool is_smooth_coat(const Material& material) {
  constexpr double least_reflectance = 0.01; // of light from everywhere, of a tenth of glass
  return material.metallic == 0.0 && !material.metallic_roughness_texture &&
         has_visible_coat(material) && may_be_smooth(material) &&
         largest(mean_shares(mirror_coat(material)).reflected) >= least_reflectance;
}

/// Whether the planes may be one, whichever way they face: those of small triangles, whose vertices are floats, are not known well. Facets of
/// curved surfaces are farther apart.
bool is_same(const Plane& a, const Plane& b, double size) {
  constexpr double angle = 2e-3, share = 2e-3;
  const double sign = glm::dot(a.normal, b.normal) < 0.0 ? -1.0 : 1.0;
  return glm::distance(a.normal, sign * b.normal) < angle &&
         std::abs(a.offset - sign * b.offset) < share * size;
}

/// What there is of a material.
struct Extent {
  std::vector<Plane> planes; ///< one more than the most that are counted
  double area = 0.0;
  bool colored = false; ///< by vertex colours
};

/// Of the materials that are marked, and of the whole scene its area.
struct Extents {
  std::vector<Extent> of_material;
  double area = 0.0;
};

Extents extents_of(const Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const Point3 middle = 0.5 * (bounds.low + bounds.high);
  const double size = glm::distance(bounds.low, bounds.high);
  Extents extents;
  extents.of_material.resize(scene.materials.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto at = corners(scene, TriangleId{t});
    const Vec3 area = area_vector(at);
    const double measure = glm::length(area);
    extents.area += measure;
    if (measure == 0.0 || !material_of(scene, TriangleId{t}).throws_as_mirror)
      continue;
    Extent& extent = extents.of_material[index(scene.triangles[t].material)];
    extent.area += measure;
    extent.colored = extent.colored || has_vertex_colors(scene, TriangleId{t});
    const Direction normal = area / measure;
    const Plane plane{normal, glm::dot(normal, at[0] - middle)};
    const auto is_known = [&](const Plane& known) { return is_same(known, plane, size); };
    if (extent.planes.size() <= most_smooth_planes && std::ranges::none_of(extent.planes, is_known))
      extent.planes.push_back(plane);
  }
  return extents;
}

/// Leaves the marks of the coats that cover most, while their planes are few.
void keep_large_coats(const Extents& extents, Scene& scene) {
  std::vector<std::size_t> by_area(scene.materials.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::ranges::stable_sort(by_area, std::ranges::greater(),
                           [&](std::size_t m) { return extents.of_material[m].area; });
  std::size_t planes = 0;
  for (const std::size_t m : by_area) {
    Material& material = scene.materials[m];
    if (!has_mirror_coat(material))
      continue;
    const Extent& extent = extents.of_material[m];
    material.throws_as_mirror = extent.area >= least_coat_share * extents.area &&
                                planes + extent.planes.size() <= most_coat_planes;
    if (material.throws_as_mirror)
      planes += extent.planes.size();
  }
}

} // namespace

void mark_smooth_surfaces(Scene& scene) {
  for (Material& material : scene.materials)
    material.throws_as_mirror = is_smooth_metal(material) || is_smooth_coat(material);
  if (std::ranges::none_of(scene.materials, &Material::throws_as_mirror))
    return;
  const Extents extents = extents_of(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    Material& material = scene.materials[m];
    const Extent& extent = extents.of_material[m];
    if (extent.planes.size() > most_smooth_planes || (extent.colored && !has_mirror_coat(material)))
      material.throws_as_mirror = false;
  }
  keep_large_coats(extents, scene);
}

void spread_coats(Scene& scene) {
  for (Material& material : scene.materials)
    if (has_mirror_coat(material))
      material.throws_as_mirror = false;
}

} // namespace meninas
