#include "raytrace/specular_paths.h"

#include "raytrace/shading.h"

#include <algorithm>

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

void go_on(const RenderContext& context, const SpecularRay& ray, TileWorkspace& work) {
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

void reflect(const RenderContext& context, const FaceRecord& face, const RayPacket& packet,
             const LaneState& state, std::uint32_t k, float distance, TileWorkspace& work) {
  SpecularRay ray = ray_from(state, k, face.plane_class, context.settings.seed);
  ray.throughput = face.reflectance * ray.throughput;
  ray.way = one_more_mirror(ray.way);
  ++ray.bounces;
  ray.world = child(context.light.worlds, ray.world, face.mirror);
  const Meeting at = meeting_of(context, face, packet, state, k, distance);
  ray.origin = at.position;
  ray.direction = at.direction - 2.0 * at.approach * face.normal;
  ray.travelled = at.travelled;
  ray.since_lobe += static_cast<float>(at.distance);
  go_on(context, ray, work);
}

/// Takes from the rays what the solids keep that they have crossed to where they are:
/// those whose surfaces they meet from inside, or else the ones they were refracted into.
static void attenuate(const RenderContext& context, const RayPacket& packet, const HitPacket& hits,
                      SpecularRay* rays) {
  const Scene& scene = context.light.scene;
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>))
      continue;
    const MaterialId met = scene.triangles[hits.triangle[k]].material;
    const bool inside = hits.front[k] == 0 && is_solid_glass(scene.materials[index(met)]);
    const MaterialId solid = inside ? met : rays[k].medium;
    if (solid == none<MaterialId>)
      continue;
    const double metres = double{hits.distance[k]} * glm::length(rays[k].direction) /
                          context.light.rays.frame().scale;
    rays[k].throughput *= glm::vec3(attenuation(scene.materials[index(solid)], metres));
  }
}

/// Traces the queued rays from `first` to `last`.
static void trace_queued(const RenderContext& context, std::size_t first, std::size_t last,
                         Backs backs, TileWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  std::array<std::uint32_t, packet_size> pixel{};
  for (; first < last; first += packet_size) {
    packet.count = static_cast<std::uint32_t>(std::min(packet_size, last - first));
    const LaneState state{pixel.data(), &work.current[first], nullptr, nullptr};
    for (std::uint32_t k = 0; k < packet.count; ++k) {
      const SpecularRay& ray = state.specular[k];
      pixel[k] = ray.pixel;
      set_ray(packet, k, glm::vec3(ray.origin), glm::vec3(ray.direction), ray.leaving);
    }
    closest_hits(context.light.rays, packet, hits, backs, Coherence::coherent);
    if (context.light.has_glass)
      attenuate(context, packet, hits, &work.current[first]);
    shade_packet(context, packet, state, hits, work);
  }
}

void follow_mirrors(const RenderContext& context, TileWorkspace& work) {
  while (!work.next.empty()) {
    work.current.swap(work.next);
    work.next.clear();
    work.specular_rays += work.current.size();
    // Rays of the eye that have but passed panes still look through backs.
    const auto turned =
        std::stable_partition(work.current.begin(), work.current.end(), [](const SpecularRay& ray) {
          return ray.way == 0 && ray.lobes == 0;
        });
    const auto straight = static_cast<std::size_t>(turned - work.current.begin());
    trace_queued(context, 0, straight, Backs::transparent, work);
    trace_queued(context, straight, work.current.size(), Backs::absorb, work);
  }
}

} // namespace meninas
