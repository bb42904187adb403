#include "scenes/rays/ray_scene.h"

#include "scenes/rays/careful_rays.h"
#include "scenes/errors.h"
#include "scenes/rays/near_planes.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

namespace meninas {

namespace {
// Surfaces nearer to an origin than `reach` times its grain touch it.
constexpr double reach = 2e-6;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

} // namespace

struct RayScene::Impl {
  Owned<RTCDevice> device;
  Owned<RTCScene> scene;
  FrameGeometry geometry;
  NearPlanes near_planes;
  float noise = 0.0F; ///< of the geometry, and the lift
};

namespace {

using Impl = RayScene::Impl;

// --- Filters

/// Embree's context, with the rule that its filter applies.
struct RayContext : RTCIntersectContext {
  RayRule rule;
};
struct LegContext : RTCIntersectContext {
  LegJudge judge;
};

/// The lanes whose hit is to be judged.
std::uint32_t hit_lanes(const RTCFilterFunctionNArguments& args) {
  LaneFlags valid{};
  if (args.N == packet_size)
    std::memcpy(valid.data(), args.valid, sizeof valid);
  else
    std::copy_n(args.valid, std::min<std::size_t>(args.N, packet_size), valid.begin());
  return bits_of(valid);
}

Candidate candidate(const RTCFilterFunctionNArguments& args, unsigned lane) {
  const auto n = args.N;
  return {RTCHitN_primID(args.hit, n, lane),
          RTCRayN_id(args.ray, n, lane),
          {RTCHitN_Ng_x(args.hit, n, lane), RTCHitN_Ng_y(args.hit, n, lane),
           RTCHitN_Ng_z(args.hit, n, lane)},
          {RTCRayN_dir_x(args.ray, n, lane), RTCRayN_dir_y(args.ray, n, lane),
           RTCRayN_dir_z(args.ray, n, lane)},
          RTCRayN_tfar(args.ray, n, lane)};
}

void filter_rays(const RTCFilterFunctionNArguments* args) {
  const auto& context = *static_cast<const RayContext*>(args->context);
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (!is_hit(context.rule, candidate(*args, lane)))
      args->valid[lane] = 0;
  }
}

void filter_legs(const RTCFilterFunctionNArguments* args) {
  auto& context = *static_cast<LegContext*>(args->context);
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (!context.judge.blocks(candidate(*args, lane)))
      args->valid[lane] = 0;
  }
}

/// Of every query, before its own filter: nothing is met in a hole.
void filter_holes(const RTCFilterFunctionNArguments* args) {
  const auto& [valid, geometry, context, ray, hit, n] = *args;
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (is_hole(*static_cast<const FrameGeometry*>(geometry), RTCHitN_primID(hit, n, lane),
                {RTCHitN_u(hit, n, lane), RTCHitN_v(hit, n, lane)}))
      valid[lane] = 0;
  }
}

RTCIntersectContextFlags flags_for(Coherence coherence) {
  return coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                          : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

RayContext make_context(const RayRule& rule, RTCIntersectContextFlags flags) {
  RayContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  context.filter = filter_rays;
  context.rule = rule;
  return context;
}

// --- Contacts: what touches the origin of a ray

struct ContactQuery {
  const FrameGeometry* geometry;
  Point3 origin;
  std::uint32_t leaving;
  double reach;
  Contacts found;
};

bool collect_contact(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<ContactQuery*>(args->userPtr);
  if (is_within(corners_of(*query.geometry, args->primID), query.origin, query.reach))
    add_contact(*query.geometry, args->primID, query.leaving, query.found);
  return false;
}

} // namespace

Contacts contacts_of(const RayScene& rays, const glm::vec3& origin, std::uint32_t leaving,
                     double least_reach) {
  ContactQuery query{&rays.geometry(), Point3(origin), leaving, std::max(reach, least_reach), {}};
  query.reach *= double{grain_at(rays.geometry(), origin)};
  RTCPointQuery point{origin.x, origin.y, origin.z, 0.0F, static_cast<float>(2.0 * query.reach)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(rays.impl().scene.get(), &point, &context, collect_contact, &query);
  return std::move(query.found);
}

LaneHit trace_one(const RayScene& rays, const LaneRay& ray, const RayRule& rule) {
  const auto& [origin, direction, near, far, leaving] = ray;
  RTCRayHit query{};
  query.ray = {origin.x,    origin.y, origin.z, near, direction.x, direction.y,
               direction.z, 0.0F,     far,      ~0U,  0U,          0U};
  query.hit.primID = no_index;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  auto context = make_context(rule, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  rtcIntersect1(rays.impl().scene.get(), &context, &query);
  const glm::vec3 normal{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
  return {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v,
          glm::dot(normal, direction) < 0.0F};
}

namespace {

// --- Packets

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
void read_hits(const RTCRayHit16& traced, const Impl& impl, HitPacket& hits, LaneFlags& touching) {
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
void trace_through(const Impl& impl, const RayPacket& packet, Coherence coherence,
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
  auto context = make_context(rule, flags_for(coherence));
  rtcIntersect16(valid.data(), impl.scene.get(), &context, &traced);
}

} // namespace

void closest_hits(const RayScene& rays, const RayPacket& packet, HitPacket& hits, Backs backs,
                  Coherence coherence) {
  const auto& impl = rays.impl();
  RTCRayHit16 traced;
  alignas(64) const auto valid = traceable_lanes(packet);
  load_rays(impl.geometry, packet, valid, traced.ray);
  clear(traced.hit);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags_for(coherence);
  rtcIntersect16(valid.data(), impl.scene.get(), &context, &traced);
  alignas(64) LaneFlags touching;
  read_hits(traced, impl, hits, touching);

  const auto doubts = find_doubts(impl.geometry, packet, hits, valid, touching, backs);
  if (doubts.through != 0) {
    trace_through(impl, packet, coherence, doubts.through, traced);
    read_hits(traced, impl, hits, touching);
  }
  const auto off = lanes_off_all_else(impl.near_planes, packet, doubts.at_contact);
  ContactMemory memory;
  for (auto rest = doubts.careful | (doubts.at_contact & ~off); rest != 0; rest &= rest - 1) {
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
  rtcInitIntersectContext(&context);
  context.flags = flags_for(coherence);
  context.filter = filter_legs;
  context.judge = {.rule = {&impl.geometry, &packet, impl.noise, solids}, .blockers = blockers};
  if (blockers)
    blockers->fill(no_index);
  rtcOccluded16(valid.data(), impl.scene.get(), &context, &traced);

  // Embree marks what is occluded by a far end of minus infinity.
  LaneFlags met;
  for (std::size_t k = 0; k < packet_size; ++k)
    met[k] = traced.tfar[k] < 0.0F ? valid[k] : 0;
  auto blocked = bits_of(met);

  const auto open_ends = context.judge.touching & ~blocked;
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

// --- Construction

namespace {

void check(RTCDevice device) {
  const auto code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE)
    return;
  throw OutputError("", "ray queries",
                    code == RTC_ERROR_OUT_OF_MEMORY
                        ? "not enough memory for the triangles of the scene"
                        : "Embree cannot be used on this machine");
}

Owned<RTCGeometry> make_mesh(RTCDevice device, const FrameGeometry& geometry) {
  Owned<RTCGeometry> mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  check(device);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), geometry.positions.size()));
  check(device);
  std::ranges::transform(geometry.positions, positions,
                         [](const Point3& x) { return glm::vec3(x); });
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), geometry.triangles.size()));
  check(device);
  std::ranges::transform(geometry.triangles, geometry.facts, triangles, met_by_rays);
  rtcSetGeometryBuildQuality(mesh.get(), RTC_BUILD_QUALITY_HIGH);
  // Filters cost time at every hit: none where nothing is cut out.
  if (std::ranges::any_of(geometry.facts, &TriangleFacts::cut_out)) {
    rtcSetGeometryUserData(mesh.get(), const_cast<FrameGeometry*>(&geometry));
    rtcSetGeometryIntersectFilterFunction(mesh.get(), filter_holes);
    rtcSetGeometryOccludedFilterFunction(mesh.get(), filter_holes);
  }
  rtcCommitGeometry(mesh.get());
  check(device);
  return mesh;
}

} // namespace

RayScene::RayScene(const Scene& scene, const SurfaceModel& surfaces, Holes holes)
    : impl_(std::make_unique<Impl>()) {
  impl_->geometry = make_frame_geometry(scene, surfaces, std::move(holes));
  impl_->near_planes = find_near_planes(impl_->geometry, reach);
  impl_->noise = static_cast<float>(impl_->geometry.noise) + lift;
  impl_->device.reset(rtcNewDevice(nullptr));
  check(impl_->device.get());
  impl_->scene.reset(rtcNewScene(impl_->device.get()));
  check(impl_->device.get());

  // Robust traversal is watertight along shared edges.
  rtcSetSceneFlags(
      impl_->scene.get(),
      static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(impl_->scene.get(), RTC_BUILD_QUALITY_HIGH);
  if (!impl_->geometry.triangles.empty()) {
    const auto mesh = make_mesh(impl_->device.get(), impl_->geometry);
    rtcAttachGeometry(impl_->scene.get(), mesh.get());
  }
  rtcCommitScene(impl_->scene.get());
  check(impl_->device.get());
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

const RayFrame& RayScene::frame() const { return impl_->geometry.frame; }
const FrameGeometry& RayScene::geometry() const { return impl_->geometry; }

} // namespace meninas
