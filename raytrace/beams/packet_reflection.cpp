#include "raytrace/beams/packet_reflection.h"

#include "raytrace/scattering.h"
#include "raytrace/shading.h"
#include "raytrace/specular_rays.h"
#include "scenes/rays/lanes.h"

#include <algorithm>

namespace meninas {

namespace {

bool is_same_mirror(const FaceRecord& a, const FaceRecord& b) {
  return b.mirrors && !b.curved && b.side == FaceRecord::nothing && a.plane_class == b.plane_class &&
         a.normal == b.normal && a.frame_offset == b.frame_offset && a.reflectance == b.reflectance;
}

/// The ideal mirror that all lanes have met, or null.
const FaceRecord* mirror_of_all(const RenderContext& context, const RayPacket& packet,
                                const HitPacket& hits) {
  const LightScene& light = context.light;
  // Where there is glass, rays are attenuated one by one, and one by one they show area lights.
  if (packet.count != packet_size || hits.triangle[0] == index(none<TriangleId>) ||
      context.settings.mode != RenderMode::hybrid || light.has_glass ||
      !light.scene.area_lights.empty())
    return nullptr;
  const FaceRecord& first = face_of(light.landing, hits, 0);
  if (!is_same_mirror(first, first) || meets_lobes(context, first, hits, 0))
    return nullptr;
  for (std::uint32_t k = 1; k < packet_size; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>))
      return nullptr;
    const bool same_face = hits.triangle[k] == hits.triangle[0] && hits.front[k] == hits.front[0];
    if (!same_face && (!is_same_mirror(first, face_of(light.landing, hits, k)) ||
                       meets_lobes(context, first, hits, k)))
      return nullptr;
  }
  return &first;
}

/// The beam of camera rays, before its first mirror.
void begin(const RayPacket& packet, MirrorBeam& beam) {
  for (std::size_t k = 0; k < packet_size; ++k) {
    beam.origin_x[k] = packet.origin_x[k];
    beam.origin_y[k] = packet.origin_y[k];
    beam.origin_z[k] = packet.origin_z[k];
    beam.direction_x[k] = packet.direction_x[k];
    beam.direction_y[k] = packet.direction_y[k];
    beam.direction_z[k] = packet.direction_z[k];
    beam.travelled[k] = 0.0F;
  }
}

/// reflect(), sixteen at a time.
void reflect_all(const FaceRecord& face, const HitPacket& hits, MirrorBeam& beam) {
  const Direction n = face.normal;
  const double offset = face.frame_offset;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const double approach =
        n.x * beam.direction_x[k] + n.y * beam.direction_y[k] + n.z * beam.direction_z[k];
    const double height = n.x * beam.origin_x[k] + n.y * beam.origin_y[k] + n.z * beam.origin_z[k];
    const double met = double{hits.distance[k]};
    const double exact = (offset - height) / approach;
    const double t = exact > 0.0 && exact <= 2.0 * met + 1e-6 ? exact : met;
    beam.origin_x[k] += t * beam.direction_x[k];
    beam.origin_y[k] += t * beam.direction_y[k];
    beam.origin_z[k] += t * beam.direction_z[k];
    const double twice = 2.0 * approach;
    beam.direction_x[k] -= twice * n.x;
    beam.direction_y[k] -= twice * n.y;
    beam.direction_z[k] -= twice * n.z;
    beam.travelled[k] += static_cast<float>(t);
  }
}

void set_rays(const MirrorBeam& beam, std::uint32_t leaving, RayPacket& packet) {
  for (std::size_t k = 0; k < packet_size; ++k) {
    packet.origin_x[k] = static_cast<float>(beam.origin_x[k]);
    packet.origin_y[k] = static_cast<float>(beam.origin_y[k]);
    packet.origin_z[k] = static_cast<float>(beam.origin_z[k]);
    packet.direction_x[k] = static_cast<float>(beam.direction_x[k]);
    packet.direction_y[k] = static_cast<float>(beam.direction_y[k]);
    packet.direction_z[k] = static_cast<float>(beam.direction_z[k]);
  }
  std::fill_n(packet.leaving, packet_size, leaving);
}

} // namespace

void trace_together(const RenderContext& context, RayPacket& packet, LaneState state,
                    TileWorkspace& work) {
  HitPacket hits;
  MirrorBeam beam;
  closest_hits(context.light.rays, packet, hits, Backs::transparent, Coherence::coherent);
  while (const FaceRecord* mirror = mirror_of_all(context, packet, hits)) {
    if (!state.beam)
      begin(packet, beam);
    state.beam = &beam;
    beam.throughput = mirror->reflectance * beam.throughput;
    beam.way = one_more_mirror(beam.way);
    ++beam.bounces;
    if (!goes_on(context, beam.bounces, beam.throughput, 1.0F))
      return;
    reflect_all(*mirror, hits, beam);
    set_rays(beam, mirror->plane_class, packet);
    work.specular_rays += packet_size;
    closest_hits(context.light.rays, packet, hits, Backs::absorb, Coherence::coherent);
  }
  shade_packet(context, packet, state, hits, work);
}

void shade_behind_mirrors(const RenderContext& context, const RayPacket& packet, LaneState state,
                          const CoherentBeam& path, const HitPacket& hits, TileWorkspace& work) {
  MirrorBeam beam;
  if (path.mirrors > 0) {
    beam.throughput = path.throughput;
    beam.way = more_mirrors(0, path.mirrors);
    beam.bounces = path.mirrors;
    state.beam = &beam;
    work.specular_rays += packet_size * static_cast<std::uint64_t>(path.mirrors);
  }
  work.sure_rays += packet_size * static_cast<std::uint64_t>(1 + path.mirrors);
  shade_alike(context, packet, state, hits, work);
}

} // namespace meninas
