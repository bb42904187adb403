#include "raytrace/specular_paths.h"

#include "raytrace/lamp_weights.h"
#include "raytrace/shading.h"

#include <algorithm>

namespace meninas {

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
    // The eye does not see area lights, what reflects shows them.
    if (backs == Backs::absorb && !context.light.scene.area_lights.empty())
      show_area_lights(context, state, packet.count, hits, work);
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
