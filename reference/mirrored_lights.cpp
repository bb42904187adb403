#include "reference/mirrored_lights.h"

#include <algorithm>
#include <cmath>

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
  const auto planes_up_to = [&](Kind last) {
    std::vector<PlaneId> planes;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
      const Kind kind = kinds[index(scene.triangles[t].material)];
      if (kind != Kind::none && kind <= last)
        planes.push_back(surfaces.plane_of_triangle[t]);
    }
    std::ranges::sort(planes);
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
  };
  MirrorPlanes result;
  for (const Kind last : {Kind::coat, Kind::pane, Kind::texels, Kind::metal}) {
    result.planes = planes_up_to(last);
    if (result.planes.size() <= most_mirror_planes)
      break;
    result.planes.clear();
  }
  const std::vector<PlaneId> metals = planes_up_to(Kind::texels);
  result.metals_left_out = std::ranges::count_if(metals, [&](PlaneId plane) {
    return !std::ranges::binary_search(result.planes, plane);
  });
  return result;
}

Point3 reflected_in(const Plane& plane, const Point3& x) {
  return x - 2.0 * signed_distance(plane, x) * plane.normal;
}

std::optional<Chain> choose_chain(const TracedScene& traced, const Point3& x, std::size_t length,
                                  double u) {
  const auto& planes = traced.mirror_planes;
  Chain chain{{}, x};
  for (std::size_t k = 0; k < length; ++k) {
    // One number makes all choices: its whole part this one, the rest the others.
    const double scaled = u * double(planes.size());
    const auto choice = std::min(static_cast<std::size_t>(scaled), planes.size() - 1);
    u = scaled - double(choice);
    // No ray meets the plane it leaves.
    if (k > 0 && chain.planes.back() == planes[choice])
      return std::nullopt;
    chain.planes.push_back(planes[choice]);
    chain.image = reflected_in(traced.surfaces.planes[index(planes[choice])], chain.image);
  }
  return chain;
}

Point3 first_target(const TracedScene& traced, const Chain& chain, Point3 y) {
  for (std::size_t k = chain.planes.size(); k-- > 0;)
    y = reflected_in(traced.surfaces.planes[index(chain.planes[k])], y);
  return y;
}

Rgb chain_throughput(const TracedScene& traced, const SurfacePoint& x, const Chain& chain,
                     const Point3& y, PlaneId arriving) {
  constexpr int most_layers = 256;
  // Nothing in the plane of a mirror is seen in it.
  if (!chain.planes.empty() && chain.planes.back() == arriving)
    return Rgb(0.0);
  Rgb throughput(1.0);
  Point3 from = x.position, target = first_target(traced, chain, y);
  PlaneId leaving = x.plane;
  std::size_t reflections = 0;
  for (int layer = 0; layer < most_layers && throughput != Rgb(0.0); ++layer) {
    const bool last_leg = reflections == chain.planes.size();
    const double length = glm::length(target - from);
    const Direction direction = (target - from) / length;
    const auto hit = closest_hit(traced.rays, {from, direction, leaving, length});
    if (!hit)
      return last_leg ? throughput : Rgb(0.0);
    const SurfacePoint at = surface_point(traced, hit->triangle, hit->barycentric, hit->front);
    if (last_leg && at.plane == arriving)
      return throughput;
    const double cosine = -glm::dot(at.normal, direction);
    from = at.position;
    leaving = at.plane;
    if (at.hole)
      continue;
    if (at.black)
      return Rgb(0.0);
    if (!last_leg && at.plane == chain.planes[reflections]) {
      throughput *= ideal_reflection(at.bsdf, cosine);
      target = reflected_in(traced.surfaces.planes[index(at.plane)], target);
      ++reflections;
    } else {
      throughput *= straight_transmission(at.bsdf, cosine);
    }
  }
  return Rgb(0.0);
}

} // namespace meninas::reference
