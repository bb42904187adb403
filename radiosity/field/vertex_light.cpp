#include "radiosity/field/vertex_light.h"

#include "scenes/rays/careful_rays.h"
#include "scenes/rays/frame_geometry.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <bit>

namespace meninas {

/// The number of directions, of sixteen over a point, that are blocked within a fraction of an element.
static std::size_t blocked_nearby(const LightScene& light, const Receiver& receiver,
                                  double element_size) {
  constexpr double reach = 0.35;
  const TangentFrame frame = frame_along(receiver.normal, receiver.tangent);
  const RayFrame& ray_frame = light.rays.frame();
  const glm::vec3 origin(to_frame(ray_frame, receiver.position));
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
  return static_cast<std::size_t>(std::popcount(occluded(light.rays, packet, Coherence::coherent)));
}

bool is_under_something(const LightScene& light, const Receiver& receiver, double element_size) {
  return blocked_nearby(light, receiver, element_size) >= packet_size - 1;
}

bool is_nearly_under_something(const LightScene& light, const Receiver& receiver,
                               double element_size) {
  // A wall beside the point blocks half of the directions, an overhang more.
  constexpr std::size_t max_blocked = packet_size / 2 + 2;
  return blocked_nearby(light, receiver, element_size) > max_blocked;
}

bool touches_wall(const LightScene& light, const Receiver& receiver) {
  constexpr double steep = 0.7; // sine of the wall's slope: facets of a curved surface are less
  const Point3 origin = to_frame(light.rays.frame(), receiver.position);
  const Contacts contacts = contacts_of(light.rays, glm::vec3(origin), index(receiver.plane_class));
  return std::ranges::any_of(contacts.others, [&](const ContactTriangle& wall) {
    const Direction& across = light.rays.geometry().plane_normals[index(wall.plane)];
    if (glm::length(glm::cross(across, receiver.normal)) <= steep)
      return false;
    // It stands on this side of the surface, not below it.
    return std::ranges::any_of(wall.corners, [&](const Point3& corner) {
      const Vec3 to = corner - origin;
      return glm::dot(to, receiver.normal) > 0.01 * glm::length(to);
    });
  });
}

/// Whether nearly all that a point sees is black.
static bool sees_black(const GatheredRays& gathered) {
  constexpr double max_black = 0.9;
  return gathered.black > max_black * gathered.rays;
}

/// The clearance of a point, by its view.
static Clearance clearance_of(bool enclosed, const LightScene& light, const Receiver& receiver,
                      double element_size) {
  if (enclosed)
    return Clearance::enclosed;
  return is_under_something(light, receiver, element_size) ? Clearance::low : Clearance::open;
}

/// Whether nearly all that a point sees is black, as few rays tell:
/// it is inside something that stands on its surface.
static bool is_enclosed_at(const LightScene& light, const FormFactorSettings& form_factors,
                       const Receiver& receiver, std::uint32_t seed, PointWorkspace& work) {
  constexpr int ray_count = 32;
  static const HemisphereSamples net = make_direction_net(ray_count);
  gather_rays(light, net, area_of(receiver), seed, form_factors, work.gather);
  work.rays += work.gather.result.traced;
  return sees_black(work.gather.result);
}

Clearance clearance_of_unlit(const LightScene& light, const FormFactorSettings& form_factors,
                        const Receiver& receiver, double element_size, std::uint32_t seed,
                        PointWorkspace& work) {
  return clearance_of(is_enclosed_at(light, form_factors, receiver, seed, work), light, receiver,
                  element_size);
}

/// Whether what was gathered is that of a point inside something,
/// or behind it, where no light comes.
static bool is_enclosed(const GatheredRays& gathered, const std::vector<Rgb>& irradiance) {
  const auto lit = [&](const ElementHit& landing) {
    return irradiance[landing.element] != Rgb(0.0);
  };
  return sees_black(gathered) ||
         (!gathered.landings.empty() && std::ranges::none_of(gathered.landings, lit));
}

/// Whether any direct light arrives.
static bool is_lit(const PointGathering& gathering, const Receiver& receiver, std::uint32_t seed,
                   PointWorkspace& work) {
  return direct_light_at(gathering, receiver, seed, work).total != Rgb(0.0);
}

bool is_open(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
             const GatheringPoint& at, PointWorkspace& work) {
  const auto& [receiver, element_size, seed] = at;
  constexpr int ray_count = 16;
  static const HemisphereSamples net = make_direction_net(ray_count);
  if (is_nearly_under_something(gathering.light, receiver, element_size))
    return false;
  gather_rays(gathering.light, net, area_of(receiver), seed, gathering.form_factors, work.gather);
  work.rays += work.gather.result.traced;
  return !is_enclosed(work.gather.result, irradiance) || is_lit(gathering, receiver, seed, work);
}

VertexValue value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                     const GatheringPoint& at, PointWorkspace& work) {
  const auto& [receiver, element_size, seed] = at;
  const PointLight arrived = light_at(gathering, receiver, seed, work);
  const bool shut =
      is_enclosed(work.gather.result, irradiance) && arrived.direct.total == Rgb(0.0);
  ArrivingLight all = arrived.all();
  all.in_part = arrived.direct.in_part;
  return {all, arrived.indirect(), clearance_of(shut, gathering.light, receiver, element_size),
          arrived.emission, arrived.hits};
}

VertexValue indirect_value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const GatheringPoint& at, PointWorkspace& work, VertexRays* kept) {
  const auto& [receiver, element_size, seed] = at;
  const bool are_there = kept != nullptr && kept->rays.rays > 0.0;
  const PointLight arrived =
      indirect_light_at(gathering, receiver, seed, work, are_there ? &kept->rays : nullptr);
  ArrivingLight indirect = arrived.indirect();
  indirect.in_part = false; // of secondary emitters
  if (kept != nullptr && !are_there)
    kept->rays = work.gather.result;
  const bool dark =
      is_enclosed(work.gather.result, irradiance) && !is_lit(gathering, receiver, seed, work);
  work.direct_by_lamp.clear(); // it has been taken already
  if (dark)
    return {indirect, indirect, Clearance::enclosed, arrived.emission, arrived.hits};
  const bool low = kept != nullptr && kept->is_under_something
                       ? *kept->is_under_something
                       : is_under_something(gathering.light, receiver, element_size);
  if (kept != nullptr)
    kept->is_under_something = low;
  return {indirect, indirect, low ? Clearance::low : Clearance::open, arrived.emission, arrived.hits};
}

ArrivingLight direct_light_by(const PointGathering& gathering, const DirectSettings& settings,
                              const Receiver& receiver, std::uint32_t seed, PointWorkspace& work) {
  const ArrivingLight light =
      direct_irradiance(gathering.light, receiver, settings, hash(seed, 1), work.direct);
  work.direct_by_lamp = work.direct.by_lamp;
  return light;
}

ArrivingLight direct_light_at(const PointGathering& gathering, const Receiver& receiver,
                              std::uint32_t seed, PointWorkspace& work) {
  return direct_light_by(gathering, gathering.direct, receiver, seed, work);
}

ArrivingLight light_beside_penumbra(const PointGathering& gathering, const Receiver& receiver,
                                    std::uint32_t seed, PointWorkspace& work) {
  DirectSettings settings = gathering.direct;
  settings.penumbra_samples = PenumbraSamples::everywhere;
  return direct_light_by(gathering, settings, receiver, seed, work);
}

} // namespace meninas
