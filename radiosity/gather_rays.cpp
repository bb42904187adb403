#include "radiosity/gather_rays.h"

#include "radiosity/surface_colour.h"
#include "scenes/lobes.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

namespace {

/// What a ray carries besides its geometry.
struct Carried {
  glm::dvec3 origin, direction;
  float weight;
  glm::vec3 throughput;
  WorldId world;
  std::uint32_t number;
  std::uint32_t meetings = 0;
  int reflections = 0;
};

/// Rays straight from the receiver are what their packet says, and `Weights` of lane k.
template <typename Weights>
struct FirstLegs {
  const RayPacket& packet;
  Weights weights;
  std::uint32_t first; ///< number of lane 0

  constexpr float weight(std::uint32_t k) const { return weights(k); }
  static constexpr glm::vec3 throughput(std::uint32_t) { return glm::vec3(1.0F); }
  static constexpr WorldId world(std::uint32_t) { return real_world; }
  Carried carried(std::uint32_t k) const {
    return {{packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]},
            {packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]},
            weight(k),
            glm::vec3(1.0F),
            real_world,
            first + k};
  }
};

/// The rays of a net weigh 1, those of a hemicube as much as their cells.
constexpr auto weights_of(const NetPacket&) {
  return [](std::uint32_t) { return 1.0F; };
}
auto weights_of(const HemicubePacket& cells) {
  return [&cells](std::uint32_t k) { return cells.weight[k]; };
}
std::size_t ray_count(const DirectionNet& net) { return net.points.size(); }
std::size_t ray_count(const Hemicube& cube) { return cube.cells; }

/// Rays that left with light of their own.
struct LitLegs {
  const LitPacket& packet;
  std::uint32_t first;

  static constexpr float weight(std::uint32_t) { return 1.0F; }
  const glm::vec3& throughput(std::uint32_t k) const { return packet.light[k]; }
  static constexpr WorldId world(std::uint32_t) { return real_world; }
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
  Carried carried(std::uint32_t k) const {
    const MirroredRay& ray = rays[k];
    return {ray.origin, ray.direction, ray.weight,   ray.throughput,
            ray.world,  ray.number,    ray.meetings, ray.reflections};
  }
};

/// What a mirror or glass makes of light that meets it at this cosine.
struct MirrorShares {
  glm::vec3 reflected, passed;
};
MirrorShares mirror_shares(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                           std::uint32_t k, double cosine) {
  if (!face.glass)
    return {face.reflectance, glm::vec3(0.0F)};
  const TriangleId triangle{hits.triangle[k]};
  const Bsdf glass =
      is_textured(material_of(light.scene, triangle)) || has_vertex_colors(light.scene, triangle)
          ? glass_at(light.scene, light.textures, triangle, {hits.b1[k], hits.b2[k]})
          : light.glass[index(light.scene.triangles[index(triangle)].material)];
  return {facet_reflectance(glass, cosine), facet_transmittance(glass, cosine)};
}

/// Where a ray meets a mirror or glass: the point comes from its exact plane, not from the rounded distance.
struct Meeting {
  glm::dvec3 position;
  double approach; ///< the direction along the normal
  MirrorShares shares;
};
Meeting meeting_of(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                   std::uint32_t k, const Carried& from) {
  const double distance = double{hits.distance[k]};
  const double approach = glm::dot(face.normal, from.direction);
  double t = (face.frame_offset - glm::dot(face.normal, from.origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6)
    t = distance;
  const double cosine = std::min(1.0, std::abs(approach) / glm::length(from.direction));
  return {from.origin + t * from.direction, approach, mirror_shares(light, face, hits, k, cosine)};
}

/// The ray that goes on: behind a mirror, or one of the two ways from glass, which stays in its world if it is passed.
MirroredRay going_on(const LightScene& light, const FaceRecord& face, const Carried& from,
                     const Meeting& at, std::uint32_t seed) {
  MirroredRay ray{at.position,      from.direction, from.weight,       from.throughput, from.world,
                  face.plane_class, from.number,    from.meetings + 1, from.reflections};
  float chance = 1.0F;
  if (face.glass) {
    const float reflected = largest(at.shares.reflected), passed = largest(at.shares.passed);
    chance = reflected + passed > 0.0F ? reflected / (reflected + passed) : 0.0F;
    if (sobol4(from.number, hash(seed, from.meetings, 0x91a55))[0] >= chance) {
      ray.throughput *= at.shares.passed / (1.0F - chance);
      return ray;
    }
  }
  ray.direction = from.direction - 2.0 * at.approach * face.normal;
  ray.throughput *= chance == 1.0F ? at.shares.reflected : at.shares.reflected / chance;
  ray.world = child(light.worlds, from.world, face.mirror);
  ++ray.reflections;
  return ray;
}

/// How rays ended: sums of their weights and of their light.
struct Ends {
  double landed = 0.0, escaped = 0.0, black = 0.0, cut = 0.0;
  std::uint32_t black_lanes = 0;
  glm::vec3 mirror_absorbed{0.0F}, escaped_light{0.0F}, black_light{0.0F}, cut_light{0.0F};

  void escape(float weight, const glm::vec3& throughput) {
    escaped += weight;
    escaped_light += weight * throughput;
    mirror_absorbed += weight * (1.0F - throughput);
  }
  void stop(float weight, const glm::vec3& throughput) {
    cut += weight;
    cut_light += weight * throughput;
    mirror_absorbed += weight * (1.0F - throughput);
  }
};

void add(const Ends& ends, GatheredRays& result) {
  result.landed += ends.landed;
  result.escaped += ends.escaped;
  result.black += ends.black;
  result.cut += ends.cut;
  result.mirror_absorbed += ends.mirror_absorbed;
  result.escaped_light += ends.escaped_light;
  result.black_light += ends.black_light;
  result.cut_light += ends.cut_light;
}

/// Sorts the hits of a packet into landings, ends and rays that go on behind a mirror. Returns the lanes that met a black back.
template <typename Legs>
std::uint32_t sort_hits(const LightScene& light, const FormFactorSettings& settings,
                        const Legs& legs, std::uint32_t count, const HitPacket& hits,
                        GatherWorkspace& work) {
  Ends ends;
  for (std::uint32_t k = 0; k < count; ++k) {
    const float weight = legs.weight(k);
    const glm::vec3 tau = legs.throughput(k);
    if (hits.triangle[k] == index(none<TriangleId>)) {
      ends.escape(weight, tau);
      continue;
    }
    const FaceRecord& face =
        light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (face.side != FaceRecord::nothing) {
      const glm::vec2 uv =
          landing_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
      RayLanding& landing = work.result.landings.emplace_back();
      landing.element = land(light.landing, face.side, uv).element;
      landing.world = legs.world(k);
      landing.light = weight * tau;
    }
    if (face.mirrors) {
      const Carried from = legs.carried(k);
      const Meeting at = meeting_of(light, face, hits, k, from);
      // What the surface keeps or scatters besides is no loss of the mirror's.
      if (face.side != FaceRecord::nothing)
        ends.mirror_absorbed -= weight * tau * (1.0F - at.shares.reflected - at.shares.passed);
      const MirroredRay ray = going_on(light, face, from, at, work.seed);
      if (largest(ray.throughput) >= settings.min_throughput &&
          ray.reflections <= settings.max_bounces)
        work.next.push_back(ray);
      else
        ends.stop(weight, ray.throughput);
      continue;
    }
    if (face.side == FaceRecord::nothing) {
      ends.black += weight;
      ends.black_lanes |= 1U << k;
      ends.black_light += weight * tau;
    } else {
      ends.landed += weight;
    }
    ends.mirror_absorbed += weight * (1.0F - tau);
  }
  add(ends, work.result);
  return ends.black_lanes;
}

/// `Rays`: a DirectionNet or a Hemicube.
template <typename Rays>
void trace_first_legs(const LightScene& light, const Rays& rays, const RaySource& source,
                      const FormFactorSettings& settings, GatherWorkspace& work) {
  work.result.clear();
  work.result.rays = static_cast<double>(ray_count(rays));
  work.next.clear();
  work.black_lanes.clear();
  RayPacket packet;
  HitPacket hits;
  for (std::size_t n = 0; n < rays.packets.size(); ++n) {
    packet.count =
        static_cast<std::uint32_t>(std::min(packet_size, ray_count(rays) - n * packet_size));
    set_rays(rays.packets[n], source, packet);
    closest_hits(light.rays, packet, hits, Backs::absorb, Coherence::coherent);
    const FirstLegs legs{packet, weights_of(rays.packets[n]),
                         static_cast<std::uint32_t>(n * packet_size)};
    work.black_lanes.push_back(sort_hits(light, settings, legs, packet.count, hits, work));
  }
  work.result.escaped_straight = work.result.escaped;
  work.result.traced += ray_count(rays);
}

/// Mirror after mirror, pane after pane, until no ray goes on.
void follow_mirrors(const LightScene& light, const FormFactorSettings& settings,
                    GatherWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  while (!work.next.empty()) {
    work.current.swap(work.next);
    work.next.clear();
    for (std::size_t first = 0; first < work.current.size(); first += packet_size) {
      packet.count = static_cast<std::uint32_t>(std::min(packet_size, work.current.size() - first));
      for (std::uint32_t k = 0; k < packet.count; ++k)
        set_ray(packet, k, work.current[first + k].origin, work.current[first + k].direction,
                work.current[first + k].leaving);
      closest_hits(light.rays, packet, hits, Backs::absorb, Coherence::coherent);
      sort_hits(light, settings, MirroredLegs{&work.current[first]}, packet.count, hits, work);
    }
    work.result.traced += work.current.size();
  }
}

/// The point's own.
std::uint32_t seed_of(const Point3& point) {
  const glm::vec3 rounded(point);
  return hash(std::bit_cast<std::uint32_t>(rounded.x), std::bit_cast<std::uint32_t>(rounded.y),
              std::bit_cast<std::uint32_t>(rounded.z));
}

} // namespace

void gather_rays(const LightScene& light, const DirectionNet& net, const ReceiverArea& receiver,
                 std::uint32_t seed, const FormFactorSettings& settings, GatherWorkspace& work) {
  const RaySource source = ray_source(receiver, light.rays.frame(), seed);
  work.seed = seed;
  trace_first_legs(light, net, source, settings, work);
  GatheredRays& result = work.result;
  if (result.black > 0.0 && !receiver.is_point()) {
    const Covered covered = find_covered(light, net, source, work.black_lanes);
    result.covered = covered.cells;
    result.covered_rays = covered.rays;
  }
  follow_mirrors(light, settings, work);
}

void gather_rays(const LightScene& light, const Hemicube& cube, const ReceiverArea& receiver,
                 const FormFactorSettings& settings, GatherWorkspace& work) {
  expects(receiver.is_point(), "a hemicube stands at a point");
  const RaySource source = ray_source(receiver, light.rays.frame(), 0);
  work.seed = seed_of(source.area.corner);
  trace_first_legs(light, cube, source, settings, work);
  follow_mirrors(light, settings, work);
}

void follow_light(const LightScene& light, std::span<const LitPacket> packets, std::uint32_t seed,
                  const FormFactorSettings& settings, GatherWorkspace& work) {
  work.result.clear();
  work.next.clear();
  work.seed = seed;
  HitPacket hits;
  for (std::uint32_t n = 0; n < packets.size(); ++n) {
    const LitPacket& packet = packets[n];
    closest_hits(light.rays, packet.rays, hits, Backs::absorb, Coherence::incoherent);
    const LitLegs legs{packet, n * std::uint32_t{packet_size}};
    sort_hits(light, settings, legs, packet.rays.count, hits, work);
    work.result.traced += packet.rays.count;
  }
  follow_mirrors(light, settings, work);
  work.result.mirror_absorbed = glm::vec3(0.0F);
}

Covered covered_part(const LightScene& light, const DirectionNet& net, const ReceiverArea& receiver,
                     std::uint32_t seed, const FormFactorSettings& settings,
                     GatherWorkspace& work) {
  const RaySource source = ray_source(receiver, light.rays.frame(), seed);
  trace_first_legs(light, net, source, settings, work);
  return work.result.black > 0.0 ? find_covered(light, net, source, work.black_lanes) : Covered{};
}

RowClosure closure_of(const GatheredRays& gathered) {
  const double exposed = gathered.rays - gathered.covered_rays;
  RowClosure closure;
  if (exposed == 0.0) {
    closure.black = 1.0F;
    closure.black_light = glm::vec3(1.0F);
    return closure;
  }
  closure.landed = static_cast<float>(gathered.landed / exposed);
  closure.escaped = static_cast<float>(gathered.escaped / exposed);
  closure.black = static_cast<float>((gathered.black - gathered.covered_rays) / exposed);
  closure.cut = static_cast<float>(gathered.cut / exposed);
  const auto share = static_cast<float>(1.0 / exposed);
  closure.mirror_absorbed = gathered.mirror_absorbed * share;
  closure.escaped_light = gathered.escaped_light * share;
  closure.black_light = (gathered.black_light - static_cast<float>(gathered.covered_rays)) * share;
  closure.cut_light = gathered.cut_light * share;
  return closure;
}

ReceiverArea receiver_of(const LightScene& light, ElementId element) {
  const MeshCell& cell = cell_of(light.mesh, element);
  const MeshSide& side = light.mesh.sides[index(cell.side)];
  return part_of_side(light, side, side.triangle,
                      [&](Vec2 st) { return patch_uv_of(light.mesh, cell, st); });
}

} // namespace meninas
