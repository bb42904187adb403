#include "scenes/smooth_metals.h"

#include "scenes/surfaces.h"
#include "scenes/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meninas {

namespace {

bool is_smooth_metal(const Material& material) {
  return is_glossy(material) && material.roughness <= smooth_metal_roughness &&
         !is_textured(material) && !is_glass(material) && !is_emitter(material) &&
         material.alpha_mode != AlphaMode::mask;
}

/// Whether the planes may be one, whichever way they face: those of small triangles, whose vertices are floats, are not known well. Facets of
/// curved surfaces are farther apart.
bool is_same(const Plane& a, const Plane& b, double size) {
  constexpr double angle = 2e-3, share = 2e-3;
  const double sign = glm::dot(a.normal, b.normal) < 0.0 ? -1.0 : 1.0;
  return glm::distance(a.normal, sign * b.normal) < angle &&
         std::abs(a.offset - sign * b.offset) < share * size;
}

} // namespace

void mark_smooth_metals(Scene& scene) {
  for (Material& material : scene.materials)
    material.throws_as_mirror = is_smooth_metal(material);
  if (std::ranges::none_of(scene.materials, &Material::throws_as_mirror))
    return;
  const Bounds bounds = bounds_of(scene);
  const Point3 middle = 0.5 * (bounds.low + bounds.high);
  const double size = glm::distance(bounds.low, bounds.high);
  std::vector<std::vector<Plane>> planes(scene.materials.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const std::size_t m = index(scene.triangles[t].material);
    Material& material = scene.materials[m];
    if (!material.throws_as_mirror)
      continue;
    const auto at = corners(scene, TriangleId{t});
    const Vec3 area = area_vector(at);
    if (area == Vec3(0.0))
      continue;
    const Direction normal = glm::normalize(area);
    const Plane plane{normal, glm::dot(normal, at[0] - middle)};
    if (std::ranges::none_of(planes[m],
                             [&](const Plane& known) { return is_same(known, plane, size); }))
      planes[m].push_back(plane);
    if (planes[m].size() > most_smooth_planes || has_vertex_colors(scene, TriangleId{t}))
      material.throws_as_mirror = false;
  }
}

} // namespace meninas
