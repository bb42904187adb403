#include "scenes/rays/ray_scene.h"

#include "scenes/rays/careful_rays.h"
#include "scenes/rays/embree_filters.h"
#include "scenes/rays/embree_handles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

namespace meninas {

namespace {

template <typename Value>
void copy_lanes(const Value* from, Value* to) {
  std::memcpy(to, from, packet_size * sizeof(Value));
}

void set_origins(const float* x, const float* y, const float* z, RTCRay16& rays) {
  copy_lanes(x, rays.org_x);
  copy_lanes(y, rays.org_y);
  copy_lanes(z, rays.org_z);
}

void set_directions(const float* x, const float* y, const float* z, RTCRay16& rays) {
  copy_lanes(x, rays.dir_x);
  copy_lanes(y, rays.dir_y);
  copy_lanes(z, rays.dir_z);
}

// Where sixteen rays are not native, Embree forgets the mask, but skips what ends before it begins.
constexpr float never = std::numeric_limits<float>::infinity();

void set_ranges(const RayPacket& packet, const LaneFlags& valid, RTCRay16& rays) {
  for (std::size_t k = 0; k < packet_size; ++k) {
    rays.tnear[k] = valid[k] != 0 ? 0.0F : never;
    rays.tfar[k] = valid[k] != 0 ? packet.max_distance[k] : 0.0F;
  }
  std::fill_n(rays.time, packet_size, 0.0F);
  std::fill_n(rays.mask, packet_size, ~0U);
  std::fill_n(rays.flags, packet_size, 0U);
  std::iota(rays.id, rays.id + packet_size, 0U);
}

void load_rays(const FrameGeometry& geometry, const RayPacket& packet, const LaneFlags& valid,
               RTCRay16& rays) {
  set_ranges(packet, valid, rays);
  set_directions(packet.direction_x, packet.direction_y, packet.direction_z, rays);
  if (leaves_nothing(packet)) {
    set_origins(packet.origin_x, packet.origin_y, packet.origin_z, rays);
    return;
  }
  const auto origins = lifted_origins(geometry, packet);
  set_origins(origins.x, origins.y, origins.z, rays);
}

void load_legs(const FrameGeometry& geometry, const RayPacket& packet, const LaneFlags& valid,
               RTCRay16& rays) {
  set_ranges(packet, valid, rays);
  const auto origins = lifted_origins(geometry, packet);
  const auto directions = lifted_directions(geometry, packet, origins);
  set_origins(origins.x, origins.y, origins.z, rays);
  set_directions(directions.x, directions.y, directions.z, rays);
}

/// `touching` are the lanes whose hit lies in a plane that their origin lies in as well.
void read_hits(const RTCRayHit16& traced, const EmbreeHandles& impl, HitPacket& hits, LaneFlags& touching) {
  const auto& [ray, hit] = traced;
  copy_lanes(hit.primID, hits.triangle);
  copy_lanes(ray.tfar, hits.distance);
  copy_lanes(hit.u, hits.b1);
  copy_lanes(hit.v, hits.b2);
  std::array<float, packet_size> slope;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const auto x = hit.Ng_x[k], y = hit.Ng_y[k], z = hit.Ng_z[k];
    slope[k] = x * ray.dir_x[k] + y * ray.dir_y[k] + z * ray.dir_z[k];
    const auto squared = x * x + y * y + z * z;
    const auto grain = grain_at(impl.geometry, ray.org_x[k], ray.org_y[k], ray.org_z[k]);
    const auto height = slope[k] * ray.tfar[k] / grain;
    touching[k] = height * height < impl.noise * impl.noise * squared ? -1 : 0;
  }
  for (std::size_t k = 0; k < packet_size; ++k)
    hits.front[k] = slope[k] < 0.0F;
}

void clear(RTCHit16& hit) {
  for (float* values : {hit.Ng_x, hit.Ng_y, hit.Ng_z, hit.u, hit.v})
    std::fill_n(values, packet_size, 0.0F);
  std::fill_n(hit.primID, packet_size, no_index);
  std::fill_n(hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(hit.instID[0], packet_size, RTC_INVALID_GEOMETRY_ID);
}

/// Goes on behind the backs that the lanes of `through` met.
void trace_through(const EmbreeHandles& impl, const RayPacket& packet, Coherence coherence,
                   std::uint32_t through, RTCRayHit16& traced) {
  alignas(64) LaneFlags valid;
  for (std::size_t k = 0; k < packet_size; ++k) {
    valid[k] = (through >> k) & 1U ? -1 : 0;
    traced.ray.tnear[k] = valid[k] != 0 ? 0.99F * traced.ray.tfar[k] : never;
    if (valid[k] == 0)
      continue;
    traced.ray.tfar[k] = packet.max_distance[k];
    traced.hit.primID[k] = no_index;
    traced.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  const RayRule rule{
      .geometry = &impl.geometry, .leaving = packet.leaving, .backs = BackRule::ignore};
  auto context = make_context(rule, coherence);
  trace(impl.traced(), valid.data(), context, traced);
}

/// The lanes of legs of which an end may touch what crosses its plane at a small angle.
std::uint32_t ends_at_grazing_faces(const NearPlanes& near, const RayPacket& legs) {
  if (!near.any_grazed)
    return 0;
  RayPacket ends = legs;
  for (std::size_t k = 0; k < packet_size; ++k) {
    ends.origin_x[k] += legs.max_distance[k] * legs.direction_x[k];
    ends.origin_y[k] += legs.max_distance[k] * legs.direction_y[k];
    ends.origin_z[k] += legs.max_distance[k] * legs.direction_z[k];
    ends.leaving[k] = legs.arriving[k];
  }
  return lanes_at_grazing_faces(near, legs) | lanes_at_grazing_faces(near, ends);
}

} // namespace

void closest_hits(const RayScene& rays, const RayPacket& packet, HitPacket& hits, Backs backs,
                  Coherence coherence) {
  const auto& impl = rays.impl();
  RTCRayHit16 traced;
  alignas(64) const auto valid = traceable_lanes(packet);
  load_rays(impl.geometry, packet, valid, traced.ray);
  clear(traced.hit);

  QueryContext context;
  init_context(context, coherence, nullptr);
  trace(impl.traced(), valid.data(), context, traced);
  alignas(64) LaneFlags touching;
  read_hits(traced, impl, hits, touching);

  const auto doubts = find_doubts(impl.geometry, packet, hits, valid, touching, backs);
  if (doubts.through != 0) {
    trace_through(impl, packet, coherence, doubts.through, traced);
    read_hits(traced, impl, hits, touching);
  }
  const auto off = lanes_off_all_else(impl.near_planes, packet, doubts.at_contact);
  ContactMemory memory;
  const auto grazing = lanes_at_grazing_faces(impl.near_planes, packet) & bits_of(valid);
  for (auto rest = doubts.careful | (doubts.at_contact & ~off) | grazing; rest != 0;
       rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    store(hits, k, careful_hit(rays, lane_ray(packet, k), backs, memory));
  }
}

std::uint32_t occluded(const RayScene& rays, const RayPacket& packet, Coherence coherence,
                       Blockers* blockers, Solids solids) {
  const auto& impl = rays.impl();
  RTCRay16 traced;
  alignas(64) const auto valid = traceable_lanes(packet);
  load_legs(impl.geometry, packet, valid, traced);

  LegContext context;
  init_context(context, coherence, filter_legs);
  context.judge = {.rule = {&impl.geometry, &packet, impl.noise, solids}, .blockers = blockers};
  if (blockers)
    blockers->fill(no_index);
  trace(impl.traced(), valid.data(), context, traced);

  // Embree marks what is occluded by a far end of minus infinity.
  LaneFlags met;
  for (std::size_t k = 0; k < packet_size; ++k)
    met[k] = traced.tfar[k] < 0.0F ? valid[k] : 0;
  auto blocked = bits_of(met);

  const auto open_ends =
      (context.judge.touching | ends_at_grazing_faces(impl.near_planes, packet)) & bits_of(valid) &
      ~blocked;
  if (open_ends == 0)
    return blocked;
  ContactMemory memory;
  for (auto rest = open_ends; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    if (blocked_at_an_end(rays, lane_ray(packet, k), packet.arriving[k], memory))
      blocked |= 1U << k;
  }
  return blocked;
}

} // namespace meninas
