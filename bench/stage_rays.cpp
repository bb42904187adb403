#include "bench/stage_rays.h"

#include "raytrace/pixels/camera_rays.h"
#include "scenes/rays/frame_geometry.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas::bench {

namespace {

RayPacket empty_packet() {
  RayPacket packet{};
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
  return packet;
}

/// Puts rays one after the other into packets.
struct PacketFiller {
  std::vector<RayPacket>& packets;
  RayPacket open = empty_packet();

  void add(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t leaving) {
    set_ray(open, open.count, origin, direction, leaving);
    if (++open.count < packet_size)
      return;
    packets.push_back(open);
    open.count = 0;
  }
};

/// Follows rays behind every mirror they meet.
void add_reflected(const LightScene& light, Backs backs, StageRays& rays) {
  constexpr int max_mirrors = 32;
  std::vector<RayPacket> current = rays.first;
  for (int mirror = 0; mirror < max_mirrors && !current.empty(); ++mirror) {
    std::vector<RayPacket> next;
    PacketFiller filler{next};
    for (const RayPacket& packet : current) {
      HitPacket hits;
      closest_hits(light.rays, packet, hits, mirror == 0 ? backs : Backs::absorb,
                   Coherence::incoherent);
      for (std::uint32_t k = 0; k < packet_size; ++k) {
        if (hits.triangle[k] == index(none<TriangleId>))
          continue;
        const auto& face = light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
        if (!face.mirrors)
          continue;
        const glm::vec3 origin{packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]};
        const glm::vec3 d{packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]};
        const glm::vec3 n(face.normal);
        filler.add(origin + hits.distance[k] * d, d - 2.0F * glm::dot(n, d) * n, face.plane_class);
      }
    }
    rays.reflected.insert(rays.reflected.end(), next.begin(), next.end());
    current = std::move(next);
  }
}

} // namespace

StageRays gather_rays_of(const LightScene& light, int rays, std::size_t packets) {
  const HemisphereSamples net = make_direction_net(rays);
  const std::size_t elements = light.mesh.area.size();
  const std::size_t used = std::max<std::size_t>(1, packets * packet_size / net.points.size());
  const RayFrame& frame = light.rays.frame();
  const auto unit = [](std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; };
  StageRays result;
  PacketFiller filler{result.first};
  for (std::size_t n = 0; n < used; ++n) {
    const auto element = static_cast<std::uint32_t>(n * elements / used);
    const ReceiverArea area = receiver_of(light, ElementId{element});
    const TangentFrame tangents = tangent_frame(area.normal);
    for (auto point : net.points) {
      for (std::uint32_t d = 0; d < 4; ++d)
        point[d] ^= hash(element, d);
      const Point3 from = point_in(area, {unit(point[0]), unit(point[1])});
      const glm::vec3 d = cosine_hemisphere(unit(point[2]), unit(point[3]));
      filler.add(glm::vec3(to_frame(frame, from)),
                 glm::vec3(double{d.x} * tangents.tangent + double{d.y} * tangents.bitangent +
                           double{d.z} * area.normal),
                 index(area.plane_class));
    }
  }
  add_reflected(light, Backs::absorb, result);
  return result;
}

StageRays camera_rays_of(const LightScene& light, const Camera& camera,
                         const RenderSettings& settings, std::size_t packets) {
  const double aspect = double(settings.width) / settings.height;
  const CameraFrame frame = make_camera_frame(camera, aspect, light.rays.frame());
  const auto samples = static_cast<std::uint32_t>(settings.samples);
  const double pixels = static_cast<double>(packets * packet_size) / samples;
  const double stride = std::max(1.0, std::sqrt(settings.width * settings.height / pixels));
  StageRays result;
  PacketFiller filler{result.first};
  for (double y = 0.0; y < settings.height; y += stride)
    for (double x = 0.0; x < settings.width; x += stride)
      for (std::uint32_t sample = 0; sample < samples; ++sample) {
        const auto point = sobol4(sample, hash(std::uint32_t(x), std::uint32_t(y)));
        const float px = (static_cast<float>(x) + point[0]) / static_cast<float>(settings.width);
        const float py = (static_cast<float>(y) + point[1]) / static_cast<float>(settings.height);
        filler.add(frame.origin + px * frame.origin_x + py * frame.origin_y,
                   frame.direction + px * frame.direction_x + py * frame.direction_y,
                   index(none<PlaneId>));
      }
  add_reflected(light, Backs::transparent, result);
  return result;
}

} // namespace meninas::bench
