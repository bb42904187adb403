#include "scenes/materials/smooth_surfaces.h"

#include "scenes/materials/lobes.h"
#include "scenes/surfaces/surfaces.h"
#include "scenes/materials/sheen.h"
#include "scenes/materials/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meninas {

namespace {

bool may_be_smooth(const Material& material) {
  return !is_glass(material) && !is_translucent(material) && !is_emitter(material) &&
         material.alpha_mode != AlphaMode::mask;
}

bool is_smooth_metal(const Material& material) {
  return is_glossy(material) && widest_roughness(material) <= smooth_metal_roughness &&
         !is_textured(material) && may_be_smooth(material);
}

/// Pictures of the paint below a coat change nothing about it.
bool is_smooth_coat(const Material& material) {
  constexpr double min_reflectance = 0.01; // of light from everywhere, of a tenth of glass
  return material.metallic == 0.0 && !material.metallic_roughness_texture &&
         material.sheen_color == Rgb(0.0) && has_visible_coat(material) && may_be_smooth(material) &&
         widest_roughness(material) <= visible_coat_roughness &&
         largest(mean_shares(mirror_coat(material)).reflected) >= min_reflectance;
}

/// Whether the planes may be one, whichever way they face: those of small triangles,
/// whose vertices are floats, are not known well. Facets of curved surfaces are farther apart.
bool is_same(const Plane& a, const Plane& b, double size) {
  constexpr double angle = 2e-3, share = 2e-3;
  const double sign = glm::dot(a.normal, b.normal) < 0.0 ? -1.0 : 1.0;
  return glm::distance(a.normal, sign * b.normal) < angle &&
         std::abs(a.offset - sign * b.offset) < share * size;
}

struct PlaneExtent {
  Plane plane;
  double area = 0.0;
};

/// Adds the area to that of the plane, which may be a new one.
void add_extent(const Plane& plane, double area, double size, std::vector<PlaneExtent>& planes) {
  const auto known = std::ranges::find_if(
      planes, [&](const PlaneExtent& extent) { return is_same(extent.plane, plane, size); });
  if (known != planes.end())
    known->area += area;
  else
    planes.push_back({plane, area});
}

/// What there is of a material.
struct Extent {
  std::vector<PlaneExtent> planes; ///< one more than the most that are counted
  bool colored = false;            ///< by vertex colours
};

/// Of the materials that are marked, and of the whole scene its area and its diameter.
struct Extents {
  std::vector<Extent> of_material;
  double area = 0.0, size = 0.0;
};

Extents extents_of(const Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const Point3 middle = 0.5 * (bounds.low + bounds.high);
  Extents extents;
  extents.size = glm::distance(bounds.low, bounds.high);
  extents.of_material.resize(scene.materials.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto at = corners(scene, TriangleId{t});
    const Vec3 area = area_vector(at);
    const double measure = glm::length(area);
    extents.area += measure;
    if (measure == 0.0 || !material_of(scene, TriangleId{t}).specular_in_pass_one)
      continue;
    Extent& extent = extents.of_material[index(scene.triangles[t].material)];
    extent.colored = extent.colored || has_vertex_colors(scene, TriangleId{t});
    const Direction normal = area / measure;
    if (extent.planes.size() <= max_smooth_planes)
      add_extent({normal, glm::dot(normal, at[0] - middle)}, measure, extents.size, extent.planes);
  }
  return extents;
}

/// Leaves the marks of coats that lie in one of the largest planes of them, whatever is below.
void keep_large_coats(const Extents& extents, Scene& scene) {
  std::vector<PlaneExtent> planes;
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (has_mirror_coat(scene.materials[m]))
      for (const PlaneExtent& own : extents.of_material[m].planes)
        add_extent(own.plane, own.area, extents.size, planes);
  std::ranges::stable_sort(planes, std::ranges::greater(), &PlaneExtent::area);
  planes.resize(std::min(planes.size(), max_coat_planes));
  std::erase_if(planes, [&](const PlaneExtent& plane) {
    return plane.area < min_coat_share * extents.area;
  });
  const auto is_large = [&](const PlaneExtent& own) {
    return std::ranges::any_of(planes, [&](const PlaneExtent& large) {
      return is_same(large.plane, own.plane, extents.size);
    });
  };
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (has_mirror_coat(scene.materials[m]))
      scene.materials[m].specular_in_pass_one =
          std::ranges::any_of(extents.of_material[m].planes, is_large);
}

} // namespace

void mark_smooth_surfaces(Scene& scene, std::span<const std::uint8_t> nearly_smooth) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    Material& material = scene.materials[m];
    const bool nearly = m < nearly_smooth.size() && nearly_smooth[m] != 0 && may_be_smooth(material);
    material.specular_in_pass_one = nearly || is_smooth_metal(material) || is_smooth_coat(material);
  }
  if (std::ranges::none_of(scene.materials, &Material::specular_in_pass_one))
    return;
  const Extents extents = extents_of(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    Material& material = scene.materials[m];
    const Extent& extent = extents.of_material[m];
    if (extent.planes.size() > max_smooth_planes || (extent.colored && !has_mirror_coat(material)))
      material.specular_in_pass_one = false;
  }
  keep_large_coats(extents, scene);
}

void spread_coats(Scene& scene) {
  for (Material& material : scene.materials)
    if (has_mirror_coat(material))
      material.specular_in_pass_one = false;
}

Rgb mirror_reflectance(const Material& material) {
  if (!is_mirror(material))
    return Rgb(0.0);
  // Below the fibres of sheen, in the mean over all directions as of films: what they reflect counts as even.
  const double below = material.sheen_color == Rgb(0.0)
                           ? 1.0
                           : 1.0 - largest(material.sheen_color) * mean_sheen_albedo(material.sheen_roughness);
  if (material.iridescence == 0.0)
    return material.base_color * (below * material.metallic);
  const ThinFilm film = film_of(material);
  const Rgb mean = mean_of_film(film, material.base_color).reflectance;
  return below_film(film, material.base_color, mean) * (below * material.metallic);
}

} // namespace meninas
