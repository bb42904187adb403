#include "raytrace/specular_paths.h"

#include "raytrace/shading.h"

#include <algorithm>

namespace meninas {

static float largest(const glm::vec3& c) { return std::max({c.r, c.g, c.b}); }

void reflect(const RenderContext& context, const FaceRecord& face, const RayPacket& packet,
             const LaneState& state, std::uint32_t k, float distance, TileWorkspace& work) {
  SpecularRay ray;
  ray.pixel = state.pixel[k];
  ray.leaving = face.plane_class;
  ray.key = state.key(k, context.settings.seed);
  ray.throughput =
      face.reflectance * (state.specular ? state.specular[k].throughput : glm::vec3(1.0F));
  if (largest(ray.throughput) < context.settings.min_throughput)
    return;

  const glm::dvec3 origin =
      state.specular ? state.specular[k].origin
                     : glm::dvec3(packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]);
  const glm::dvec3 d = state.specular ? state.specular[k].direction
                                      : glm::dvec3(packet.direction_x[k], packet.direction_y[k],
                                                   packet.direction_z[k]);
  const double approach = glm::dot(face.normal, d);
  double t = (face.frame_offset - glm::dot(face.normal, origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6)
    t = distance;
  ray.travelled =
      static_cast<float>(t) + (state.specular ? state.specular[k].travelled : 0.0F);
  ray.origin = origin + t * d;
  ray.direction = d - 2.0 * approach * face.normal;
  work.next.push_back(ray);
}

void follow_mirrors(const RenderContext& context, TileWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  std::array<std::uint32_t, packet_size> pixel;
  for (int bounce = 0; !work.next.empty() && bounce < context.settings.max_bounces; ++bounce) {
    work.current.swap(work.next);
    work.next.clear();
    work.way = std::min(work.way + 1, seen_ways - 1);
    work.specular_rays += work.current.size();
    for (std::size_t first = 0; first < work.current.size(); first += packet_size) {
      packet.count = static_cast<std::uint32_t>(std::min(packet_size, work.current.size() - first));
      const LaneState state{pixel.data(), &work.current[first], nullptr};
      for (std::uint32_t k = 0; k < packet.count; ++k) {
        const SpecularRay& ray = state.specular[k];
        pixel[k] = ray.pixel;
        set_ray(packet, k, glm::vec3(ray.origin), glm::vec3(ray.direction), ray.leaving);
      }
      closest_hits(context.light.rays, packet, hits, Backs::absorb, Coherence::coherent);
      shade_packet(context, packet, state, hits, work);
    }
  }
  work.next.clear();
}

} // namespace meninas
