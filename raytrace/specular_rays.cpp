#include "raytrace/specular_rays.h"

#include "raytrace/lane_surface.h"
#include "scenes/shading_normal.h"

namespace meninas {

Meeting meeting_of(const RenderContext& context, const FaceRecord& face, const RayPacket& packet,
                   const LaneState& state, std::uint32_t k, float distance) {
  glm::dvec3 origin, d;
  if (state.specular) {
    origin = state.specular[k].origin;
    d = state.specular[k].direction;
  } else if (state.beam) {
    const MirrorBeam& beam = *state.beam;
    origin = {beam.origin_x[k], beam.origin_y[k], beam.origin_z[k]};
    d = {beam.direction_x[k], beam.direction_y[k], beam.direction_z[k]};
  } else {
    origin = {packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]};
    d = {packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]};
  }
  const double approach = glm::dot(face.normal, d);
  double t = (face.frame_offset - glm::dot(face.normal, origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6)
    t = distance;
  return {origin + t * d, d, t / context.light.rays.frame().scale, approach,
          state.travelled(k) + static_cast<float>(t)};
}

void queue_if_visible(const RenderContext& context, const SpecularRay& ray, TileWorkspace& work) {
  if (goes_on(context, ray.bounces, ray.throughput, ray.share))
    work.next.push_back(ray);
}

SpecularRay ray_from(const LaneState& state, std::uint32_t k, std::uint32_t leaving,
                     std::uint32_t seed) {
  SpecularRay ray;
  if (state.specular)
    ray = state.specular[k];
  ray.throughput = state.throughput(k);
  ray.way = static_cast<std::uint16_t>(state.way(k));
  if (state.beam)
    ray.bounces = state.beam->bounces;
  ray.pixel = state.pixel[k];
  ray.leaving = leaving;
  ray.key = state.key(k, seed);
  ray.number = state.number_of(k);
  return ray;
}

/// The direction behind the mirror, as long as the one before it.
static glm::dvec3 mirrored(const LandedLane& lane, const Meeting& at) {
  if (!lane.face.curved)
    return at.direction - 2.0 * at.approach * lane.face.normal;
  const Direction n = normal_towards(lane, -glm::normalize(at.direction));
  return kept_above(at.direction - 2.0 * glm::dot(n, at.direction) * n, lane.face.normal);
}

void reflect(const LandedLane& lane, TileWorkspace& work) {
  const auto& [context, packet, state, face, hits, k] = lane;
  SpecularRay ray = ray_from(state, k, face.plane_class, context.settings.seed);
  ray.throughput = face.reflectance * ray.throughput;
  ray.way = one_more_mirror(ray.way);
  ++ray.bounces;
  // A ray that a normal map turns aside is in no mirror world.
  ray.world = face.mapped ? none<WorldId> : child(context.light.worlds, ray.world, face.mirror);
  const Meeting at = meeting_of(context, face, packet, state, k, hits.distance[k]);
  ray.origin = at.position;
  ray.direction = mirrored(lane, at);
  ray.travelled = at.travelled;
  ray.since_lobe += static_cast<float>(at.distance);
  queue_if_visible(context, ray, work);
}

} // namespace meninas
