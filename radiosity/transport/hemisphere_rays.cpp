#include "radiosity/transport/hemisphere_rays.h"

#include "radiosity/transport/gather_legs.h"
#include "radiosity/transport/ray_comb.h"
#include "radiosity/scene/surface_colour.h"
#include "scenes/materials/lobes.h"
#include "scenes/sampling.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace meninas {

namespace {

const Bsdf& coat_of(const LightScene& light, TriangleId triangle) {
  return light.by_angle[index(light.scene.triangles[index(triangle)].material)];
}
/// The shares of light that a mirror, glass or a coat reflects and passes at this cosine.
struct MirrorShares {
  glm::vec3 reflected, passed;
};
MirrorShares mirror_shares(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                           std::uint32_t k, double cosine) {
  const TriangleId triangle{hits.triangle[k]};
  if (face.coat)
    return {facet_reflectance(coat_of(light, triangle), cosine), glm::vec3(0.0F)};
  if (!face.glass)
    return {face.reflectance, glm::vec3(0.0F)};
  if (face.solid) {
    const Bsdf solid = solid_face(light, triangle, {hits.b1[k], hits.b2[k]}, hits.front[k] != 0);
    return {facet_reflectance(solid, cosine), facet_transmittance(solid, cosine)};
  }
  const Bsdf glass =
      is_textured(material_of(light.scene, triangle)) || has_vertex_colors(light.scene, triangle)
          ? glass_at(light.scene, light.textures, triangle, {hits.b1[k], hits.b2[k]})
          : light.by_angle[index(light.scene.triangles[index(triangle)].material)];
  return {facet_reflectance(glass, cosine), facet_transmittance(glass, cosine)};
}

/// The face that lane k of a packet has hit.
struct MetFace {
  const FaceRecord& face;
  const HitPacket& hits;
  std::uint32_t k;
};

/// Where a ray meets a mirror, glass or a coat: on its exact plane, not at the rounded distance.
struct Meeting {
  glm::dvec3 position;
  double along; ///< the ray's directions from its origin to there
  Direction normal; ///< towards the ray; it turns with a curved surface
  double approach;  ///< the direction along the normal
  double cosine;
  MirrorShares shares;
};
/// The normal by which what was met reflects a ray.
Direction normal_met(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                     std::uint32_t k, const Carried& from) {
  if (!face.curved)
    return face.normal;
  const Direction n =
      shading_normal(light.scene, TriangleId{hits.triangle[k]}, {hits.b1[k], hits.b2[k]});
  return visible_normal(hits.front[k] != 0 ? n : -n, face.normal, -glm::normalize(from.direction));
}

Meeting meeting_of(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                   std::uint32_t k, const Carried& from) {
  const double distance = double{hits.distance[k]};
  const double approach = glm::dot(face.normal, from.direction);
  double t = (face.frame_offset - glm::dot(face.normal, from.origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6)
    t = distance;
  const Direction normal = normal_met(light, face, hits, k, from);
  const double along = face.curved ? glm::dot(normal, from.direction) : approach;
  const double cosine = std::min(1.0, std::abs(along) / glm::length(from.direction));
  return {from.origin + t * from.direction, t, normal, along, cosine,
          mirror_shares(light, face, hits, k, cosine)};
}

glm::dvec3 mirrored(const Carried& from, const Meeting& at, const FaceRecord& face) {
  const glm::dvec3 direction = from.direction - 2.0 * at.approach * at.normal;
  return face.curved ? kept_above(direction, face.normal) : direction;
}

WorldId reflected_world(const LightScene& light, const FaceRecord& face, const Carried& from) {
  if (face.solid)
    return world_from_solid(from.world, from.meetings == 0, true);
  return is_by_solids(from.world) ? off_solids : child(light.worlds, from.world, face.mirror);
}

/// Sends a ray on through a face, straight or as its solid bends it; not if it cannot be.
bool pass(const LightScene& light, const MetFace& met, const Direction& normal,
          const Carried& from, MirroredRay& ray) {
  const auto& [face, hits, k] = met;
  if (!face.solid)
    return true;
  const TriangleId triangle{hits.triangle[k]};
  const bool front = hits.front[k] != 0;
  const auto behind = refracted(light, triangle, front, normal, from.direction);
  if (!behind)
    return false;
  ray.direction = face.curved ? kept_above(*behind, -face.normal) : *behind;
  ray.medium = medium_behind(light, triangle, front);
  ray.world = world_from_solid(from.world, from.meetings == 0, false);
  return true;
}

/// The number in [0, 1) by which a ray goes one of two ways. Numbers of one dimension,
/// however scrambled, follow one another: behind the first meeting they are random.
float choice_of(const Carried& from, std::uint32_t seed, std::uint32_t kind) {
  const std::uint32_t key = hash(seed, from.meetings, kind);
  return from.meetings == 0 ? sobol4(from.number, key)[0]
                            : 0x1p-24F * static_cast<float>(hash(from.number, key) >> 8U);
}

/// The ray that goes on: behind a mirror, or one of the two ways from glass,
/// which stays in its world if it passes a pane.
MirroredRay going_on(const LightScene& light, const MetFace& met, const Carried& from,
                     const Meeting& at, std::uint32_t seed) {
  const auto& [face, hits, k] = met;
  MirroredRay ray{at.position,       from.direction,           from.weight,
                  from.throughput,   from.world,               from.medium,
                  0.0,               face.plane_class,         from.number,
                  from.meetings + 1, from.reflections};
  float chance = 1.0F;
  if (face.glass) {
    const float reflected = largest(at.shares.reflected), passed = largest(at.shares.passed);
    chance = reflected + passed > 0.0F ? reflected / (reflected + passed) : 0.0F;
    if (choice_of(from, seed, 0x91a55) >= chance && pass(light, met, at.normal, from, ray)) {
      ray.throughput *= at.shares.passed / (1.0F - chance);
      ray.straight = from.straight + at.along;
      return ray;
    }
  }
  ray.direction = mirrored(from, at, face);
  ray.throughput *= chance == 1.0F ? at.shares.reflected : at.shares.reflected / chance;
  ray.world = reflected_world(light, face, from);
  ++ray.reflections;
  return ray;
}

/// A coat takes its part of what lands below it. The light of a ray that it reflects, if it does.
std::optional<MirroredRay> meet_coat(const LightScene& light, const MetFace& met,
                                     const Carried& from, std::uint32_t seed, ElementHit* landing) {
  const auto& [face, hits, k] = met;
  const Meeting at = meeting_of(light, face, hits, k, from);
  if (landing != nullptr)
    landing->light *=
        glm::vec3(coat_transmittance(coat_of(light, TriangleId{hits.triangle[k]}), at.cosine));
  // Lamps that no closed form owns are met there by many rays with little light, not few with all.
  const WorldId world = reflected_world(light, face, from);
  const float chance = world == none<WorldId> ? 1.0F : largest(at.shares.reflected);
  if (choice_of(from, seed, 0xc0a7) >= chance)
    return std::nullopt;
  return MirroredRay{at.position, mirrored(from, at, face), from.weight,
                     from.throughput * at.shares.reflected / chance, world, from.medium, 0.0,
                     face.plane_class, from.number, from.meetings + 1, from.reflections + 1};
}

ElementHit& note_landing(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                         std::uint32_t k, GatherWorkspace& work) {
  const glm::vec2 uv = hit_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
  const Landing at = land(light.landing.elements, face.side, uv);
  if (work.keeps_places)
    work.places.push_back(at.st);
  ElementHit& landing = work.result.landings.emplace_back();
  landing.element = at.element;
  return landing;
}

/// Sorts the hits of a packet into landings, ends and rays that go on behind a mirror.
/// Returns the lanes that met a black back.
template <typename Legs>
std::uint32_t sort_hits(const LightScene& light, const FormFactorSettings& settings,
                        const Legs& legs, std::uint32_t count, const HitPacket& hits,
                        GatherWorkspace& work) {
  Ends ends;
  const auto follow = [&](const FaceRecord& face, float weight, const MirroredRay& ray) {
    if (largest(ray.throughput) >= settings.min_throughput &&
        ray.reflections <= settings.max_bounces && !(face.solid && ray.meetings > max_meetings))
      work.next.push_back(ray);
    else
      ends.stop(weight, ray.throughput);
  };
  for (std::uint32_t k = 0; k < count; ++k) {
    const float weight = legs.weight(k);
    glm::vec3 tau = legs.throughput(k);
    if (hits.triangle[k] == index(none<TriangleId>)) {
      ends.escape(weight, tau);
      if (light.sky != nullptr || !light.portals.empty())
        meet_sky(light, legs.carried(k), weight * tau, ends);
      continue;
    }
    const FaceRecord& face =
        light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (legs.medium(k) != none<MaterialId> || (face.solid && hits.front[k] == 0))
      tau *= transmittance_on_leg(light, legs, hits, k);
    if (face.side != FaceRecord::nothing) {
      note_landing(light, face, hits, k, work).light = weight * tau;
      work.result.landings.back().world = legs.world(k);
      if (work.counts_rays)
        work.numbers.push_back(legs.carried(k).number);
    }
    if (face.mirrors) {
      Carried from = legs.carried(k);
      from.throughput = tau;
      const Meeting at = meeting_of(light, face, hits, k, from);
      // Light that the surface keeps or scatters besides is no loss of the mirror's.
      if (face.side != FaceRecord::nothing)
        ends.mirror_absorbed -= weight * tau * (1.0F - at.shares.reflected - at.shares.passed);
      follow(face, weight, going_on(light, {face, hits, k}, from, at, work.seed));
      continue;
    }
    if (face.coat) [[unlikely]] {
      ElementHit* const landing =
          face.side != FaceRecord::nothing ? &work.result.landings.back() : nullptr;
      Carried from = legs.carried(k);
      from.throughput = tau;
      if (const auto ray = meet_coat(light, {face, hits, k}, from, work.seed, landing)) {
        // The surface has all of the light, and what is reflected is on its way.
        ends.mirror_absorbed -= weight * (tau - ray->throughput);
        follow(face, weight, *ray);
        continue;
      }
    }
    ends.end(face.side == FaceRecord::nothing, k, weight, tau);
  }
  add(ends, work.result);
  return ends.black_lanes;
}

/// `Rays`: a HemisphereSamples or a Hemicube.
template <typename Rays>
void trace_first_legs(const LightScene& light, const Rays& rays, const RaySource& source,
                      const FormFactorSettings& settings, GatherWorkspace& work) {
  work.result.clear();
  work.result.rays = static_cast<double>(ray_count(rays));
  work.places.clear();
  work.next.clear();
  work.black_lanes.clear();
  RayPacket packet;
  HitPacket hits;
  for (std::size_t n = 0; n < rays.packets.size(); ++n) {
    packet.count =
        static_cast<std::uint32_t>(std::min(packet_size, ray_count(rays) - n * packet_size));
    set_rays(rays.packets[n], source, packet);
    closest_hits(light.rays, packet, hits, Backs::absorb, Coherence::coherent);
    const auto first = first_of(rays) + static_cast<std::uint32_t>(n * packet_size);
    const auto sort = [&](auto&& let_in) {
      const FirstLegs legs{packet, weights_of(rays.packets[n]), let_in, first};
      return sort_hits(light, settings, legs, packet.count, hits, work);
    };
    if (source.area.coat == none<MaterialId>) {
      work.black_lanes.push_back(sort([](std::uint32_t) { return glm::vec3(1.0F); }));
      continue;
    }
    const auto let_in = let_in_by(light.by_angle[index(source.area.coat)], source, packet);
    work.black_lanes.push_back(sort([&](std::uint32_t k) { return let_in[k]; }));
  }
  work.result.escaped_straight = work.result.escaped_light;
  work.result.owned_straight = work.result.owned_light;
  work.result.sky_straight = work.result.sky;
  work.result.traced += ray_count(rays);
}

/// Mirror after mirror, pane after pane, until no ray goes on.
void follow_mirrors(const LightScene& light, const FormFactorSettings& settings, GatherWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  Bounces bounces{1, work.next.size()};
  for (; !work.next.empty(); ++bounces.done) {
    comb_rays(work.next, bounces, work.seed);
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

} // namespace

/// All rays of a receiver that is covered as a whole count as black, also those that begin on its
/// rim, within rounding of the outside.
static void forget_rays(GatheredRays& result, GatherWorkspace& work) {
  const double rays = result.rays;
  const std::uint64_t traced = result.traced;
  result.clear();
  result.rays = result.black = rays;
  result.black_light = glm::vec3(static_cast<float>(rays));
  result.traced = traced;
  work.next.clear();
}

/// The source of rays of a receiver. Each face of a cluster is a source of its own, and all share one net.
static RaySource source_of(const LightScene& light, const ReceiverArea& receiver, std::uint32_t seed) {
  RaySource source = ray_source(receiver, light.rays.frame(), seed);
  double area = 0.0;
  for (const ElementId f : receiver.faces) {
    source.faces.push_back(ray_source(receiver_of(light, f), light.rays.frame(), seed));
    source.area_up_to.push_back(area += light.mesh.area[index(f)]);
  }
  return source;
}

void gather_rays(const LightScene& light, const HemisphereSamples& net, const ReceiverArea& receiver,
                 std::uint32_t seed, const FormFactorSettings& settings, GatherWorkspace& work) {
  const RaySource source = source_of(light, receiver, seed);
  work.seed = seed;
  trace_first_legs(light, net, source, settings, work);
  GatheredRays& result = work.result;
  if (!receiver.faces.empty()) {
    result.covered = result.black > 0.0 ? 1 : 0; // by what, its faces tell
  } else if (result.black > 0.0 && !receiver.is_point()) {
    const Covered covered = find_covered(light, net, source, work.black_lanes);
    if (covered.cells == wholly_covered)
      forget_rays(result, work);
    result.covered = covered.cells;
    result.covered_rays = covered.rays;
    result.exposed = covered.exposed;
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

void follow_into(const LightScene& light, std::uint32_t body, std::span<const LitPacket> packets,
                 std::uint32_t seed, const FormFactorSettings& settings, GatherWorkspace& work) {
  work.result.clear();
  work.next.clear();
  work.numbers.clear();
  work.counts_rays = true;
  work.seed = seed;
  HitPacket hits;
  for (std::uint32_t n = 0; n < packets.size(); ++n) {
    const LitPacket& packet = packets[n];
    closest_hits(light.rays, packet.rays, hits, Backs::absorb, Coherence::coherent);
    for (std::uint32_t k = 0; k < packet.rays.count; ++k) // what goes elsewhere is not followed
      if (hits.triangle[k] != index(none<TriangleId>) &&
          light.solids.body_of_triangle[hits.triangle[k]] != body)
        hits.triangle[k] = index(none<TriangleId>);
    const LitLegs legs{packet, n * std::uint32_t{packet_size}};
    sort_hits(light, settings, legs, packet.rays.count, hits, work);
    work.result.traced += packet.rays.count;
  }
  follow_mirrors(light, settings, work);
  work.counts_rays = false;
}

Covered covered_part(const LightScene& light, const HemisphereSamples& net, const ReceiverArea& receiver,
                     std::uint32_t seed, const FormFactorSettings& settings,
                     GatherWorkspace& work) {
  const RaySource source = ray_source(receiver, light.rays.frame(), seed);
  trace_first_legs(light, net, source, settings, work);
  return work.result.black > 0.0 ? find_covered(light, net, source, work.black_lanes) : Covered{};
}

ReceiverArea receiver_of(const LightScene& light, ElementId element) {
  const MeshCell& cell = cell_of(light.mesh, element);
  const MeshSide& side = light.mesh.sides[index(cell.side)];
  ReceiverArea area = part_of_side(light, side, side.triangle,
                                   [&](Vec2 st) { return patch_uv_of(light.mesh, cell, st); });
  area.region = region_of(light.mesh, element);
  return area;
}

} // namespace meninas
