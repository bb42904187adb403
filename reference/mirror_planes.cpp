#include "reference/mirror_planes.h"

#include "scenes/materials/normal_map.h"

#include <algorithm>

namespace meninas::reference {

/// Texels say where it is metal and how smooth: a mirror on some of them.
static bool mirrors_by_texels(const Material& material, const DecodedTextures& textures) {
  if (!material.metallic_roughness_texture || material.metallic == 0.0)
    return false;
  const auto& texels = textures.numbers[index(material.metallic_roughness_texture->texture)].texels;
  return std::ranges::any_of(texels, [&](const glm::vec4& texel) {
    return material.roughness * double{texel.g} <= ideal_mirror_roughness && texel.b > 0.0F;
  });
}

MirrorPlanes find_mirror_planes(const Scene& scene, const SurfaceModel& surfaces,
                                const std::vector<Bsdf>& bsdfs, const DecodedTextures& textures) {
  enum class Kind { none, metal, texels, pane, coat };
  std::vector<Kind> kinds;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const Bsdf& bsdf = bsdfs[m];
    Kind kind = Kind::none;
    if (bsdf.alpha == 0.0 && bsdf.metal != Rgb(0.0))
      kind = Kind::metal;
    else if (mirrors_by_texels(material, textures))
      kind = Kind::texels;
    else if (bsdf.alpha == 0.0 && bsdf.glass > 0.0 && !is_solid_glass(material))
      kind = Kind::pane;
    else if (bsdf.alpha == 0.0 && has_mirror_coat(material))
      kind = Kind::coat;
    kinds.push_back(kind);
  }
  // Only planes have images: the facets of a curved mirror stand for it nowhere.
  const auto planes_up_to = [&](Kind last, bool with_curved = false) {
    std::vector<PlaneId> planes;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
      const Kind kind = kinds[index(scene.triangles[t].material)];
      const bool bent = is_bent(scene, TriangleId{static_cast<std::uint32_t>(t)});
      if (kind != Kind::none && kind <= last && (with_curved || !bent))
        planes.push_back(surfaces.plane_of_triangle[t]);
    }
    std::ranges::sort(planes);
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
  };
  MirrorPlanes result;
  for (const Kind last : {Kind::coat, Kind::pane, Kind::texels, Kind::metal}) {
    result.planes = planes_up_to(last);
    if (result.planes.size() <= max_mirror_planes)
      break;
    result.planes.clear();
  }
  const std::vector<PlaneId> metals = planes_up_to(Kind::texels, true);
  result.metals_left_out = std::ranges::count_if(metals, [&](PlaneId plane) {
    return !std::ranges::binary_search(result.planes, plane);
  });
  return result;
}

Point3 reflected_in(const Plane& plane, const Point3& x) {
  return x - 2.0 * signed_distance(plane, x) * plane.normal;
}

} // namespace meninas::reference
