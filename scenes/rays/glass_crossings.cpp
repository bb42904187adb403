#include "scenes/rays/glass_crossings.h"

#include "scenes/rays/careful_rays.h"

#include <algorithm>
#include <cmath>

namespace meninas {

/// Whether the ends are on different sides.
static bool parts(const Plane& plane, const Leg& leg) {
  return signed_distance(plane, leg.from) * signed_distance(plane, leg.to) <= 0.0;
}

static LaneRay ray_along(const FrameGeometry& geometry, const Leg& leg) {
  LaneRay ray;
  ray.origin = glm::vec3(to_frame(geometry.frame, leg.from));
  ray.direction = glm::vec3((leg.to - leg.from) * geometry.frame.scale);
  ray.leaving = index(leg.leaving);
  return ray;
}

static GlassCrossing crossing_of(const FrameGeometry& geometry, const LaneRay& ray,
                                 const LaneHit& hit) {
  const Direction& normal = geometry.plane_normals[geometry.facts[hit.triangle].plane];
  const Vec3 direction(ray.direction);
  return {TriangleId{hit.triangle},
          {hit.b1, hit.b2},
          std::abs(glm::dot(normal, direction)) / glm::length(direction)};
}

void glass_crossings(const RayScene& rays, const Leg& leg, std::vector<GlassCrossing>& crossings) {
  crossings.clear();
  const FrameGeometry& geometry = rays.geometry();
  // Few planes are asked first: most legs cross none of them.
  constexpr std::size_t few = 32;
  if (geometry.glass.size() <= few &&
      std::ranges::none_of(geometry.glass, [&](const Plane& plane) { return parts(plane, leg); }))
    return;
  LaneRay ray = ray_along(geometry, leg);
  ray.far = 1.0F;
  const RayRule rule{.geometry = &geometry, .leaving = &ray.leaving, .only_glass = true};
  std::vector<LaneHit> hits;
  trace_all(rays, ray, rule, hits);
  // A pane that is passed is left as a surface is: nothing in its plane is met again.
  std::uint32_t left = no_index;
  for (const LaneHit& hit : hits) {
    const std::uint32_t plane = geometry.facts[hit.triangle].plane;
    if (plane != left && plane != index(leg.arriving))
      crossings.push_back(crossing_of(geometry, ray, hit));
    left = plane;
  }
}

std::optional<GlassCrossing> glass_at_end(const RayScene& rays, const Leg& leg, PlaneId plane) {
  const FrameGeometry& geometry = rays.geometry();
  // The one crossing of the plane, which rounding may put behind the end.
  LaneRay ray = ray_along(geometry, leg);
  ray.far = 2.0F;
  const RayRule rule{.geometry = &geometry,
                     .leaving = &ray.leaving,
                     .only_plane = index(plane),
                     .only_glass = true};
  const LaneHit hit = trace_one(rays, ray, rule);
  if (hit.triangle == no_index)
    return std::nullopt;
  return crossing_of(geometry, ray, hit);
}

} // namespace meninas
