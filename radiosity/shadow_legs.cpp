#include "radiosity/shadow_legs.h"

#include <algorithm>
#include <cmath>

namespace meninas {

/// A fan triangle by area, then a point in it.
Point3 point_on(const ConvexPolygon& polygon, const Vec3& area, Vec2 sample) {
  const double total = glm::dot(area, area);
  double before = 0.0;
  for (std::size_t k = 2; k < polygon.size; ++k) {
    const Vec3 edge_a = polygon.vertices[k - 1] - polygon.vertices[0],
               edge_b = polygon.vertices[k] - polygon.vertices[0];
    const double share = 0.5 * glm::dot(glm::cross(edge_a, edge_b), area) / total;
    if (sample.x < before + share || k + 1 == polygon.size) {
      const double u = share > 0.0 ? std::clamp((sample.x - before) / share, 0.0, 1.0) : 0.5;
      const double root = std::sqrt(u);
      return polygon.vertices[0] + root * (1.0 - sample.y) * edge_a + root * sample.y * edge_b;
    }
    before += share;
  }
  return polygon.vertices[0];
}

std::uint32_t blocked(const LightScene& light, const std::array<std::vector<Leg>, 16>& folded,
                      std::uint32_t count, std::uint64_t& rays) {
  const RayFrame& frame = light.rays.frame();
  std::uint32_t result = 0;
  RayPacket packet;
  packet.count = count;
  for (std::size_t step = 0; step < folded[0].size(); ++step) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const Leg& leg = folded[k][step];
      const Vec3 from = (leg.from - frame.centre) * frame.scale,
                 along = (leg.to - leg.from) * frame.scale;
      set_ray(packet, k, from, along, index(leg.leaving), 1.0F);
      packet.arriving[k] = index(leg.arriving);
    }
    result |= occluded(light.rays, packet, Coherence::coherent);
    rays += count;
    if (result == (1U << count) - 1U)
      break;
  }
  return result;
}

} // namespace meninas
