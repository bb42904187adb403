// The rays of one step of gathering (hemisphere_rays.h), lane by lane of a packet:
// from the receiver, from where something has shot them, or from mirrors.
//
// All say the weight of lane k, its throughput and its world, and all that it carries.
// Glass and coats change the throughput of a leg:
//
//   into the receiver's coat   tau_0 = (1 - R(cos)) / (1 - R_mean)
//   through d metres of glass  tau *= attenuation_color^(d / attenuation_distance)
#pragma once

#include "radiosity/transport/gathered_rays.h"
#include "radiosity/transport/glass_rays.h"
#include "scenes/materials/lobes.h"
#include "scenes/sampling.h"
#include "scenes/sky/radiance_map.h"

#include <bit>

namespace meninas {

/// The point's own.
inline std::uint32_t seed_of(const Point3& point) {
  const glm::vec3 rounded(point);
  return hash(std::bit_cast<std::uint32_t>(rounded.x), std::bit_cast<std::uint32_t>(rounded.y),
              std::bit_cast<std::uint32_t>(rounded.z));
}

/// The state of a ray from leg to leg.
struct Carried {
  glm::dvec3 origin, direction;
  float weight;
  glm::vec3 throughput;
  WorldId world;
  std::uint32_t number;
  std::uint32_t meetings = 0;
  int reflections = 0;
  MaterialId medium = none<MaterialId>;
  double straight = 0.0; ///< in directions: so far behind the origin it has set out or was last reflected
};

/// Rays straight from the receiver are what their packet says,
/// `Weights` of lane k and what the receiver's coat lets in of it.
template <typename Weights, typename LetIn>
struct FirstLegs {
  const RayPacket& packet;
  Weights weights;
  LetIn let_in;
  std::uint32_t first; ///< number of lane 0

  constexpr float weight(std::uint32_t k) const { return weights(k); }
  constexpr glm::vec3 throughput(std::uint32_t k) const { return let_in(k); }
  static constexpr WorldId world(std::uint32_t) { return real_world; }
  static constexpr MaterialId medium(std::uint32_t) { return none<MaterialId>; }
  Carried carried(std::uint32_t k) const {
    return {{packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]},
            {packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]},
            weight(k),
            throughput(k),
            real_world,
            first + k};
  }
};
// clang deduces aggregates by themselves from its version 17 on.
template <typename Weights, typename LetIn>
FirstLegs(const RayPacket&, Weights, LetIn, std::uint32_t) -> FirstLegs<Weights, LetIn>;

/// The transmittance of the receiver's coat, by lane.
inline std::array<glm::vec3, packet_size>
let_in_by(const Bsdf& coat, const RaySource& source, const RayPacket& packet) {
  std::array<glm::vec3, packet_size> light{};
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    const Vec3 direction(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
    light[k] = glm::vec3(
        coat_transmittance(coat, glm::dot(direction, source.area.normal) / glm::length(direction)));
  }
  return light;
}

/// The rays of a net weigh 1, those of a hemicube as much as their cells.
constexpr auto weights_of(const NetPacket&) {
  return [](std::uint32_t) { return 1.0F; };
}
inline auto weights_of(const HemicubePacket& cells) {
  return [&cells](std::uint32_t k) { return cells.weight[k]; };
}
inline std::size_t ray_count(const HemisphereSamples& net) { return net.points.size(); }
inline std::size_t ray_count(const Hemicube& cube) { return cube.cells; }
inline std::uint32_t first_of(const HemisphereSamples& net) { return net.first; }
inline std::uint32_t first_of(const Hemicube&) { return 0; }

/// Rays that left with light of their own.
struct LitLegs {
  const LitPacket& packet;
  std::uint32_t first;

  static constexpr float weight(std::uint32_t) { return 1.0F; }
  const glm::vec3& throughput(std::uint32_t k) const { return packet.light[k]; }
  static constexpr WorldId world(std::uint32_t) { return real_world; }
  static constexpr MaterialId medium(std::uint32_t) { return none<MaterialId>; }
  Carried carried(std::uint32_t k) const {
    const RayPacket& rays = packet.rays;
    return {{rays.origin_x[k], rays.origin_y[k], rays.origin_z[k]},
            {rays.direction_x[k], rays.direction_y[k], rays.direction_z[k]},
            1.0F,
            packet.light[k],
            real_world,
            first + k};
  }
};

/// Rays from mirrors have their record.
struct MirroredLegs {
  const MirroredRay* rays;

  float weight(std::uint32_t k) const { return rays[k].weight; }
  const glm::vec3& throughput(std::uint32_t k) const { return rays[k].throughput; }
  WorldId world(std::uint32_t k) const { return rays[k].world; }
  MaterialId medium(std::uint32_t k) const { return rays[k].medium; }
  Carried carried(std::uint32_t k) const {
    const MirroredRay& ray = rays[k];
    return {ray.origin, ray.direction, ray.weight,      ray.throughput, ray.world,
            ray.number, ray.meetings,  ray.reflections, ray.medium, ray.straight};
  }
};

/// The transmittance of a leg that has ended in lane k.
template <typename Legs>
glm::vec3 transmittance_on_leg(const LightScene& light, const Legs& legs, const HitPacket& hits,
                      std::uint32_t k) {
  const Vec3 direction = legs.carried(k).direction;
  const double metres =
      double{hits.distance[k]} * glm::length(direction) / light.rays.frame().scale;
  return left_by_solid(light, TriangleId{hits.triangle[k]}, hits.front[k] != 0, legs.medium(k),
                       metres);
}

/// Adds the radiance of the sky that an escaping ray finds, apart where a portal owns it.
inline void meet_sky(const LightScene& light, const Carried& ray, const glm::vec3& left, Ends& ends) {
  const RayFrame& frame = light.rays.frame();
  // Panes on the way are passed straight: the whole of the last leg counts, as for shadow rays.
  const Point3 from = (ray.origin - ray.straight * ray.direction) / frame.scale + frame.centre;
  const bool owned =
      !light.portals.empty() && ray.world != none<WorldId> && !is_by_solids(ray.world) &&
      last_portal(light.portals, from, ray.direction,
                  min_height(light.surfaces.tolerance, ray.reflections > 0)) != no_portal;
  if (owned)
    ends.owned_light += left;
  if (light.sky != nullptr)
    (owned ? ends.by_portals : ends.sky) +=
        left * radiance_from(*light.sky, ray.direction, Suns::left_out);
}

} // namespace meninas
