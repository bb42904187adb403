#include "radiosity/mesh/dark_sides.h"

#include "radiosity/mesh/enclosed_sides.h"
#include "scenes/sampling.h"
#include "scenes/surfaces/curved_patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

namespace meninas {

namespace {

constexpr std::uint32_t probe_rays = 256;
constexpr std::uint32_t probe_points = 8;
constexpr std::size_t max_emitter_probes = 4'000'000; ///< beyond that every side is meshed

Vec2 spread(const Patch& patch, float s, float t) {
  Vec2 uv(s, t);
  return patch.corner_count == 3 && s + t > 1.0F ? 1.0 - uv : uv;
}

bool everything_escapes(const RayScene& rays, const Patch& patch, PlaneId plane,
                        const Direction& normal) {
  const TangentFrame frame = tangent_frame(normal);
  for (std::uint32_t k = 0; k < probe_rays; ++k) {
    const auto sample = sobol4(k, 0x51de);
    const glm::vec3 local = cosine_hemisphere(sample[2], sample[3]);
    Ray ray;
    ray.origin = point_at(patch, spread(patch, sample[0], sample[1]));
    ray.direction = glm::normalize(double{local.x} * frame.tangent +
                                   double{local.y} * frame.bitangent + double{local.z} * normal);
    ray.leaving = plane;
    if (closest_hit(rays, ray))
      return false;
  }
  return true;
}

/// Some probe point sees some point of the emitter's plane region in front of the side.
bool sees_emitter(const RayScene& rays, const Patch& patch, const Plane& plane, PlaneId plane_class,
                  const Patch& emitter, PlaneId emitter_plane) {
  for (std::uint32_t k = 0; k < probe_points; ++k) {
    const auto sample = sobol4(k, 0xe311);
    const Point3 from = point_at(patch, spread(patch, sample[0], sample[1]));
    const Point3 to = point_at(emitter, spread(emitter, sample[2], sample[3]));
    if (signed_distance(plane, to) > 0.0 && !occluded(rays, {from, to, plane_class, emitter_plane}))
      return true;
  }
  return false;
}

/// Some probe point sees the light, in front of the side; whatever its cone.
bool sees_light(const RayScene& rays, const Patch& patch, const Plane& plane, PlaneId plane_class,
                const PunctualLight& light) {
  for (std::uint32_t k = 0; k < probe_points; ++k) {
    const auto sample = sobol4(k, 0xe311);
    const Point3 from = point_at(patch, spread(patch, sample[0], sample[1]));
    if (light.kind != PunctualKind::directional) {
      if (signed_distance(plane, light.position) > 0.0 &&
          !occluded(rays, {from, light.position, plane_class, none<PlaneId>}))
        return true;
    } else if (glm::dot(plane.normal, light.direction) < 0.0 &&
               !closest_hit(
                   rays, {.origin = from, .direction = -light.direction, .leaving = plane_class})) {
      return true;
    }
  }
  return false;
}

/// Some probe point sees some point of the light in front of the side; whichever way it shines.
bool sees_light(const RayScene& rays, const Patch& patch, const Plane& plane, PlaneId plane_class,
                const AreaLight& light) {
  const auto& p = light.corners;
  for (std::uint32_t k = 0; k < probe_points; ++k) {
    const auto sample = sobol4(k, 0xe311);
    const Point3 from = point_at(patch, spread(patch, sample[0], sample[1]));
    const std::size_t corner = 1 + k % (p.size() - 2);
    const Point3 edge = glm::mix(p[corner], p[corner + 1], double{sample[2]});
    const Point3 to = glm::mix(p[0], edge, std::sqrt(double{sample[3]}));
    if (signed_distance(plane, to) > 0.0 && !occluded(rays, {from, to, plane_class, none<PlaneId>}))
      return true;
  }
  return false;
}

/// Sides that are lit by what escaping rays would come to.
bool is_lit(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
            std::span<const Patch* const> emitters, const Patch& patch, const Plane& plane) {
  const PlaneId plane_class = surfaces.surfaces[index(patch.surface)].plane_class;
  return std::ranges::any_of(scene.lights,
                             [&](const PunctualLight& light) {
                               return sees_light(rays, patch, plane, plane_class, light);
                             }) ||
         std::ranges::any_of(scene.area_lights,
                             [&](const AreaLight& light) {
                               return sees_light(rays, patch, plane, plane_class, light);
                             }) ||
         std::ranges::any_of(emitters, [&](const Patch* emitter) {
           return sees_emitter(rays, patch, plane, plane_class, *emitter,
                               surfaces.surfaces[index(emitter->surface)].plane_class);
         });
}

/// Sides of patches all of whose triangles are enclosed.
DarkSides enclosed_patches(const SurfaceModel& surfaces, const EnclosedSides& enclosed) {
  DarkSides dark;
  for (const Patch& patch : surfaces.patches) {
    std::array<std::uint8_t, 2> both{1, 1};
    for (const TriangleId triangle : patch.triangles)
      for (std::size_t facing = 0; triangle != none<TriangleId> && facing < 2; ++facing)
        both[facing] = std::min(both[facing], enclosed[index(triangle)][facing]);
    dark.push_back(both);
  }
  return dark;
}

} // namespace

DarkSides find_dark_sides(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays) {
  const auto material_of_patch = [&](const Patch& patch) -> const Material& {
    return scene.materials[index(patch.material)];
  };
  std::vector<const Patch*> emitters;
  std::size_t double_sided = 0;
  for (const auto& patch : surfaces.patches) {
    if (is_emitter(material_of_patch(patch)))
      emitters.push_back(&patch);
    if (material_of_patch(patch).double_sided)
      ++double_sided;
  }

  DarkSides dark = enclosed_patches(surfaces, find_enclosed_sides(scene, surfaces));
  for (std::size_t p = 0; p < dark.size(); ++p)
    if (material_of_patch(surfaces.patches[p]).unlit)
      dark[p] = {0, 0}; // it is seen in the dark
  const std::size_t sources = emitters.size() + scene.lights.size() + scene.area_lights.size();
  if (double_sided * sources * 2 * probe_points > max_emitter_probes ||
      !is_dark(scene.background))
    return dark;
  tbb::parallel_for(std::size_t{0}, surfaces.patches.size(), [&](std::size_t p) {
    const Patch& patch = surfaces.patches[p];
    const Material& material = material_of_patch(patch);
    // Light may reach a curve over a facet that it does not reach, and comes through translucent surfaces.
    if (!material.double_sided || is_translucent(material) || is_emitter(material) ||
        material.unlit || material.normal_texture || is_curved(scene, patch))
      return;
    const Surface& surface = surfaces.surfaces[index(patch.surface)];
    for (std::size_t facing = 0; facing < 2; ++facing) {
      const double sign = facing == 0 ? 1.0 : -1.0;
      const Plane plane{sign * surface.plane.normal, sign * surface.plane.offset};
      if (dark[p][facing] == 0 &&
          everything_escapes(rays, patch, surface.plane_class, plane.normal) &&
          !is_lit(scene, surfaces, rays, emitters, patch, plane))
        dark[p][facing] = 1;
    }
  });
  return dark;
}

} // namespace meninas
