#include "bench/bare_embree.h"

#include <algorithm>

namespace meninas::bench {

static constexpr float bare_epsilon = 1e-5F;

BareScene make_bare_scene(const FrameGeometry& geometry, RTCSceneFlags flags) {
  BareScene bare{rtcNewDevice(nullptr), nullptr};
  bare.scene = rtcNewScene(bare.device);
  rtcSetSceneFlags(bare.scene, flags);
  rtcSetSceneBuildQuality(bare.scene, RTC_BUILD_QUALITY_HIGH);
  const auto mesh = rtcNewGeometry(bare.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                              geometry.positions.size()));
  std::ranges::transform(geometry.positions, positions,
                         [](const Point3& x) { return glm::vec3(x); });
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, geometry.triangles.size()));
  std::ranges::copy(geometry.triangles, triangles);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(bare.scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(bare.scene);
  return bare;
}

void release(const BareScene& bare) {
  rtcReleaseScene(bare.scene);
  rtcReleaseDevice(bare.device);
}

static void fill(const RayPacket& packet, float near, float far_share, RTCRay16& ray) {
  for (std::size_t k = 0; k < packet_size; ++k) {
    ray.org_x[k] = packet.origin_x[k];
    ray.org_y[k] = packet.origin_y[k];
    ray.org_z[k] = packet.origin_z[k];
    ray.dir_x[k] = packet.direction_x[k];
    ray.dir_y[k] = packet.direction_y[k];
    ray.dir_z[k] = packet.direction_z[k];
    ray.tnear[k] = near;
    ray.tfar[k] = far_share * packet.max_distance[k];
    ray.time[k] = 0.0F;
    ray.mask[k] = ~0U;
    ray.flags[k] = 0U;
  }
}

std::uint32_t trace_bare(const BareScene& bare, Query query, Coherence coherence,
                         const RayPacket& packet) {
  alignas(64) static constexpr int valid[packet_size] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                         -1, -1, -1, -1, -1, -1, -1, -1};
  QueryContext context;
  init_context(context, coherence, nullptr);
  std::uint32_t met = 0;
  if (query == Query::occlusion) {
    RTCRay16 ray;
    fill(packet, bare_epsilon, 1.0F - bare_epsilon, ray);
    trace(valid, bare.scene, context, ray);
    for (std::size_t k = 0; k < packet_size; ++k)
      met += ray.tfar[k] < 0.0F;
    return met;
  }
  RTCRayHit16 traced;
  fill(packet, bare_epsilon, 1.0F, traced.ray);
  std::fill_n(traced.hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
  trace(valid, bare.scene, context, traced);
  for (std::size_t k = 0; k < packet_size; ++k)
    met += traced.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
  return met;
}

} // namespace meninas::bench
