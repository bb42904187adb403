#include "radiosity/vertex_light.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <bit>

namespace meninas {

bool is_under_something(const LightScene& light, const Receiver& receiver, double element_size) {
  constexpr double reach = 0.35; // of an element
  constexpr int least = packet_size - 1;
  const TangentFrame frame = frame_along(receiver.normal, receiver.tangent);
  const RayFrame& ray_frame = light.rays.frame();
  const glm::vec3 origin = (receiver.position - ray_frame.centre) * ray_frame.scale;
  RayPacket packet;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const auto sample = sobol4(k, 0xc0fe);
    const glm::vec3 local = cosine_hemisphere(sample[0], sample[1]);
    const glm::vec3 direction = double{local.x} * frame.tangent +
                                double{local.y} * frame.bitangent +
                                double{local.z} * receiver.normal;
    set_ray(packet, k, origin, direction, index(receiver.plane_class),
            static_cast<float>(reach * element_size * ray_frame.scale));
    packet.arriving[k] = index(none<PlaneId>);
  }
  return std::popcount(occluded(light.rays, packet, Coherence::coherent)) >= least;
}

bool sees_black(const GatheredRays& gathered) {
  constexpr double most_black = 0.9;
  return gathered.black > most_black * gathered.rays;
}

/// Whether what was gathered is that of a point inside something, or behind it, where no light comes.
static bool is_enclosed(const GatheredRays& gathered, const std::vector<Rgb>& irradiance) {
  const auto lit = [&](const RayLanding& landing) {
    return irradiance[landing.element] != Rgb(0.0);
  };
  return sees_black(gathered) ||
         (!gathered.landings.empty() && std::ranges::none_of(gathered.landings, lit));
}

VertexValue value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                     const Receiver& receiver, double element_size, std::uint32_t seed,
                     PointWorkspace& work) {
  const PointLight arrived = light_at(gathering, receiver, seed, work);
  const bool covered =
      (is_enclosed(work.gather.result, irradiance) && arrived.from_source.total == Rgb(0.0)) ||
      is_under_something(gathering.light, receiver, element_size);
  return {arrived.all(), arrived.indirect(), covered};
}

VertexValue indirect_value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const Receiver& receiver, double element_size, std::uint32_t seed,
                              PointWorkspace& work) {
  const ArrivingLight indirect = indirect_light_at(gathering, receiver, seed, work).indirect();
  const bool dark =
      is_enclosed(work.gather.result, irradiance) &&
      direct_irradiance(gathering.light, receiver, gathering.direct, hash(seed, 1), work.direct)
              .total == Rgb(0.0);
  return {indirect, indirect, dark || is_under_something(gathering.light, receiver, element_size)};
}

VertexValue value_from_source(const PointGathering& gathering, const Receiver& receiver,
                              double element_size, std::uint32_t seed, PointWorkspace& work) {
  return {
      direct_irradiance(gathering.light, receiver, gathering.direct, hash(seed, 1), work.direct),
      {},
      is_under_something(gathering.light, receiver, element_size)};
}

} // namespace meninas
