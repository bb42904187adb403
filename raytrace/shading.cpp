#include "raytrace/shading.h"

#include "raytrace/quad_lanes.h"
#include "raytrace/specular_paths.h"

namespace meninas {

namespace {

/// Adds what each ray has landed on to its pixel, and queues the rays that a mirror sends on.
void shade_one_by_one(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                      const HitPacket& hits, TileWorkspace& work) {
  const LightScene& light = context.light;
  const bool mirrors = context.settings.mode == RenderMode::hybrid;
  glm::vec3 sum(0.0F); // of lanes of one pixel in a row
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] != index(none<TriangleId>)) {
      const FaceRecord& face = face_of(light.landing, hits, k);
      if (face.side != FaceRecord::nothing) {
        const glm::vec2 uv = uv_of(light, face, hits, k);
        const glm::vec3 radiance =
            field_radiance(light.mesh, context.visible.irradiance,
                           context.visible.shading[face.side], light.landing, face.side, uv);
        sum += state.specular ? state.specular[k].throughput * radiance : radiance;
      }
      if (face.mirrors && mirrors)
        reflect(context, face, packet, state, k, hits.distance[k], work);
    }
    if (k + 1 < packet.count && state.pixel[k + 1] == state.pixel[k])
      continue;
    work.sums[work.way][state.pixel[k]] += sum;
    sum = glm::vec3(0.0F);
  }
}

/// The common case of sixteen samples of one pixel that land on one quad side. Returns false where they do not.
bool shade_as_one(const RenderContext& context, const LaneState& state, const HitPacket& hits,
                  TileWorkspace& work) {
  std::uint32_t differ = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= hits.triangle[k] ^ hits.triangle[0];
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= static_cast<std::uint32_t>(hits.front[k] ^ hits.front[0]);
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= state.pixel[k] ^ state.pixel[0];
  if (differ != 0)
    return false;
  if (hits.triangle[0] == index(none<TriangleId>))
    return true;
  const LightScene& light = context.light;
  const FaceRecord& face = face_of(light.landing, hits, 0);
  if (face.mirrors || face.side == FaceRecord::nothing || light.landing.sides[face.side].triangle)
    return false;
  glm::vec3 throughput(1.0F);
  if (state.specular) {
    throughput = state.specular[0].throughput;
    for (std::uint32_t k = 1; k < packet_size; ++k)
      if (state.specular[k].throughput != throughput)
        return false;
  }

  const LanePoints at = land_on_quad(light, face, light.landing.sides[face.side], hits);
  work.sums[work.way][state.pixel[0]] +=
      throughput * quad_radiance(light.mesh, context.visible, face.side, at);
  return true;
}

} // namespace

void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                  const HitPacket& hits, TileWorkspace& work) {
  if (packet.count == packet_size && shade_as_one(context, state, hits, work))
    return;
  shade_one_by_one(context, packet, state, hits, work);
}

} // namespace meninas
