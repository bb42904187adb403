#include "scenes/ray_scene.h"

#include "scenes/contacts.h"
#include "scenes/errors.h"
#include "scenes/frame_geometry.h"
#include "scenes/lanes.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace meninas {

namespace {

// Surfaces nearer to an origin than `reach` touch it.
constexpr double reach = 2e-6;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle, typename Release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

} // namespace

struct RayScene::Impl {
  Owned<RTCDevice, ReleaseDevice> device;
  Owned<RTCScene, ReleaseScene> scene;
  FrameGeometry geometry;
  float noise = 0.0F; ///< of the geometry, and the lift
};

namespace {

using Impl = RayScene::Impl;

// --- Filters: what a repeated query must not hit

enum class BackRule { hit, ignore };

/// Hits in the plane that is left, in the planes of touching triangles and, by the rule, on backs are rejected.
/// Where only one plane is looked for, all others are rejected.
struct Rejection : RTCIntersectContext {
  const Impl* impl = nullptr;
  const std::uint32_t* leaving = nullptr; ///< by lane
  const Contacts* contacts = nullptr;
  BackRule backs = BackRule::hit;
  std::uint32_t only_plane = no_index;
};

glm::vec3 normal_of(const RTCFilterFunctionNArguments& args, unsigned lane) {
  return {RTCHitN_Ng_x(args.hit, args.N, lane), RTCHitN_Ng_y(args.hit, args.N, lane),
          RTCHitN_Ng_z(args.hit, args.N, lane)};
}

glm::vec3 direction_of(const RTCFilterFunctionNArguments& args, unsigned lane) {
  return {RTCRayN_dir_x(args.ray, args.N, lane), RTCRayN_dir_y(args.ray, args.N, lane),
          RTCRayN_dir_z(args.ray, args.N, lane)};
}

bool is_back(const RTCFilterFunctionNArguments& args, unsigned lane) {
  return glm::dot(normal_of(args, lane), direction_of(args, lane)) >= 0.0F;
}

bool touches(const Contacts* contacts, std::uint32_t plane) {
  return contacts && std::ranges::any_of(contacts->others, [&](const ContactTriangle& contact) {
           return index(contact.plane) == plane;
         });
}

void reject_hits(const RTCFilterFunctionNArguments* args) {
  const auto& rule = *static_cast<const Rejection*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    const auto facts = rule.impl->geometry.facts[RTCHitN_primID(args->hit, args->N, lane)];
    const auto ray = RTCRayN_id(args->ray, args->N, lane);
    const auto rejected = facts.plane == rule.leaving[ray] || touches(rule.contacts, facts.plane) ||
                          (rule.only_plane != no_index && facts.plane != rule.only_plane) ||
                          (rule.backs == BackRule::ignore && facts.single_sided && is_back(*args, lane));
    if (rejected) args->valid[lane] = 0;
  }
}

RTCIntersectContextFlags flags_for(Coherence coherence) {
  return coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                          : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

Rejection make_rejection(const Impl& impl, const std::uint32_t* leaving) {
  Rejection rejection;
  rtcInitIntersectContext(&rejection);
  rejection.filter = reject_hits;
  rejection.impl = &impl;
  rejection.leaving = leaving;
  return rejection;
}

LaneHit trace(const Impl& impl, const LaneRay& ray, Rejection& rejection) {
  RTCRayHit query{};
  query.ray = {ray.origin.x,    ray.origin.y,    ray.origin.z,    ray.near, ray.direction.x, ray.direction.y,
               ray.direction.z, 0.0F, ray.far, ~0U,      0U,              0U};
  query.hit.primID = no_index;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl.scene.get(), &rejection, &query);
  const glm::vec3 normal{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
  return {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v, glm::dot(normal, ray.direction) < 0.0F};
}

// --- Contacts: what touches the origin of a ray

struct ContactQuery {
  const Impl* impl;
  Point3 origin;
  std::uint32_t leaving;
  Contacts found;
};

bool collect_contact(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<ContactQuery*>(args->userPtr);
  const auto corners = corners_of(query.impl->geometry, args->primID);
  if (distance_to(corners, query.origin) > reach) return false;

  const auto& facts = query.impl->geometry.facts[args->primID];
  auto& list = facts.plane == query.leaving ? query.found.own : query.found.others;
  const auto known = std::ranges::any_of(
      list, [&](const ContactTriangle& contact) { return index(contact.triangle) == args->primID; });
  if (!known)
    list.push_back({TriangleId{args->primID}, PlaneId{facts.plane},
                    facts.single_sided ? Sidedness::single : Sidedness::both, corners});
  return false;
}

Contacts contacts_of(const Impl& impl, const glm::vec3& origin, std::uint32_t leaving) {
  ContactQuery query{&impl, Point3(origin), leaving, {}};
  RTCPointQuery point{origin.x, origin.y, origin.z, 0.0F, static_cast<float>(2.0 * reach)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl.scene.get(), &point, &context, collect_contact, &query);
  return std::move(query.found);
}

/// The contacts of the last origin asked for: the rays of a packet often share theirs.
struct ContactMemory {
  glm::vec3 origin{std::numeric_limits<float>::quiet_NaN()};
  std::uint32_t leaving = no_index;
  Contacts contacts;
};

const Contacts& remembered_contacts(const Impl& impl, ContactMemory& memory, const glm::vec3& origin,
                                    std::uint32_t leaving) {
  if (memory.origin != origin || memory.leaving != leaving)
    memory = {origin, leaving, contacts_of(impl, origin, leaving)};
  return memory.contacts;
}

/// The contact that blocks what departs from an origin over `extent`: a leg's whole length, or a ray's unit direction.
std::optional<ContactTriangle> blocked_at_once(const Impl& impl, const Contacts& contacts,
                                               const LaneRay& ray, const Vec3& extent) {
  if (contacts.others.empty()) return std::nullopt;
  return blocking_contact(contacts, {Point3(ray.origin), extent, impl.geometry.plane_normals[ray.leaving]},
                          impl.geometry.noise);
}

// --- The nearest hit of one ray, with all care

/// A back that shares its plane with a front is one side of a sheet, and the side that faces the ray is hit.
LaneHit facing_side(const Impl& impl, const LaneRay& ray, const LaneHit& back) {
  auto rejection = make_rejection(impl, &ray.leaving);
  rejection.backs = BackRule::ignore;
  rejection.only_plane = impl.geometry.facts[back.triangle].plane;
  auto around = ray;
  around.near = 0.99F * back.distance;
  around.far = std::min(ray.far, 1.01F * back.distance);
  const auto face = trace(impl, around, rejection);
  return face.triangle == no_index ? back : face;
}

LaneHit careful_hit(const Impl& impl, const LaneRay& ray, Backs backs, ContactMemory& memory) {
  auto rejection = make_rejection(impl, &ray.leaving);
  rejection.backs = backs == Backs::transparent ? BackRule::ignore : BackRule::hit;

  // Surfaces that touch the origin are met at distance zero or not at all.
  if (ray.leaving != no_index) {
    const auto& contacts = remembered_contacts(impl, memory, ray.origin, ray.leaving);
    if (const auto wall = blocked_at_once(impl, contacts, ray, glm::normalize(Vec3(ray.direction)))) {
      const auto front = glm::dot(area_vector(wall->corners), Vec3(ray.direction)) < 0.0;
      const auto weights = nearest_barycentric(wall->corners, Point3(ray.origin));
      if (front || backs == Backs::absorb || wall->sidedness == Sidedness::both)
        return {index(wall->triangle), 0.0F, static_cast<float>(weights.x), static_cast<float>(weights.y), front};
    }
    rejection.contacts = &contacts;
  }

  const auto hit = trace(impl, ray, rejection);
  if (hit.triangle == no_index || hit.front) return hit;
  const auto& facts = impl.geometry.facts[hit.triangle];
  return facts.single_sided && facts.in_sheet ? facing_side(impl, ray, hit) : hit;
}

// --- Packets

void load(const RayPacket& packet, RTCRay16& rays) {
  std::copy_n(packet.origin_x, packet_size, rays.org_x);
  std::copy_n(packet.origin_y, packet_size, rays.org_y);
  std::copy_n(packet.origin_z, packet_size, rays.org_z);
  std::copy_n(packet.direction_x, packet_size, rays.dir_x);
  std::copy_n(packet.direction_y, packet_size, rays.dir_y);
  std::copy_n(packet.direction_z, packet_size, rays.dir_z);
  std::copy_n(packet.max_distance, packet_size, rays.tfar);
  std::fill_n(rays.tnear, packet_size, 0.0F);
  std::fill_n(rays.time, packet_size, 0.0F);
  std::fill_n(rays.mask, packet_size, ~0U);
  std::fill_n(rays.flags, packet_size, 0U);
  std::iota(rays.id, rays.id + packet_size, 0U);
}

/// Reads a traced packet; `touching` are the lanes whose hit lies in a plane that their origin lies in as well.
void read_hits(const RTCRayHit16& traced, float noise, HitPacket& hits, LaneFlags& touching) {
  const auto& [ray, hit] = traced;
  std::copy_n(hit.primID, packet_size, hits.triangle);
  std::copy_n(ray.tfar, packet_size, hits.distance);
  std::copy_n(hit.u, packet_size, hits.b1);
  std::copy_n(hit.v, packet_size, hits.b2);
  std::array<float, packet_size> slope;
  for (std::size_t k = 0; k < packet_size; ++k) {
    slope[k] = hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
    const auto squared = hit.Ng_x[k] * hit.Ng_x[k] + hit.Ng_y[k] * hit.Ng_y[k] + hit.Ng_z[k] * hit.Ng_z[k];
    const auto height = slope[k] * ray.tfar[k];
    touching[k] = height * height < noise * noise * squared ? -1 : 0;
  }
  for (std::size_t k = 0; k < packet_size; ++k) hits.front[k] = slope[k] < 0.0F;
}

void clear_hits(RTCHit16& hit) {
  std::fill_n(hit.Ng_x, packet_size, 0.0F);
  std::fill_n(hit.Ng_y, packet_size, 0.0F);
  std::fill_n(hit.Ng_z, packet_size, 0.0F);
  std::fill_n(hit.u, packet_size, 0.0F);
  std::fill_n(hit.v, packet_size, 0.0F);
  std::fill_n(hit.primID, packet_size, no_index);
  std::fill_n(hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(hit.instID[0], packet_size, RTC_INVALID_GEOMETRY_ID);
}

/// Goes on behind the backs that the lanes of `through` met.
void trace_through(const Impl& impl, const RayPacket& packet, Coherence coherence, std::uint32_t through,
                   RTCRayHit16& traced) {
  alignas(64) LaneFlags valid;
  for (std::size_t k = 0; k < packet_size; ++k) {
    valid[k] = (through >> k) & 1U ? -1 : 0;
    if (valid[k] == 0) continue;
    traced.ray.tnear[k] = 0.99F * traced.ray.tfar[k];
    traced.ray.tfar[k] = packet.max_distance[k];
    traced.hit.primID[k] = no_index;
    traced.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  auto rejection = make_rejection(impl, packet.leaving);
  rejection.flags = flags_for(coherence);
  rejection.backs = BackRule::ignore;
  rtcIntersect16(valid.data(), impl.scene.get(), &rejection, &traced);
}

} // namespace

void closest_hits(const RayScene& rays, const RayPacket& packet, HitPacket& hits, Backs backs,
                  Coherence coherence) {
  const auto& impl = rays.impl();
  RTCRayHit16 traced;
  alignas(64) const auto valid = traceable_lanes(packet);
  load(lifted_rays(impl.geometry, packet), traced.ray);
  clear_hits(traced.hit);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags_for(coherence);
  rtcIntersect16(valid.data(), impl.scene.get(), &context, &traced);
  alignas(64) LaneFlags touching;
  read_hits(traced, impl.noise, hits, touching);

  const auto doubts = find_doubts(impl.geometry, packet, hits, valid, touching, backs);
  if (doubts.through != 0) {
    trace_through(impl, packet, coherence, doubts.through, traced);
    read_hits(traced, impl.noise, hits, touching);
  }
  if (doubts.careful == 0) return;
  ContactMemory memory;
  for (auto rest = doubts.careful; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    store(hits, k, careful_hit(impl, lane_ray(packet, k), backs, memory));
  }
}

namespace {

/// Hits in the planes at both ends do not block; hits on triangles in whose plane an end lies are left to its contacts.
struct LegRejection : RTCIntersectContext {
  const Impl* impl = nullptr;
  const RayPacket* packet = nullptr;
  std::uint32_t touching = 0; ///< lanes with a hit that touches an end
};

void reject_ends(const RTCFilterFunctionNArguments* args) {
  auto& rule = *static_cast<LegRejection*>(args->context);
  const auto& packet = *rule.packet;
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    const auto plane = rule.impl->geometry.facts[RTCHitN_primID(args->hit, args->N, lane)].plane;
    const auto k = RTCRayN_id(args->ray, args->N, lane);
    if (plane == packet.leaving[k] || plane == packet.arriving[k]) {
      args->valid[lane] = 0;
      continue;
    }
    // How far the leg climbs from its start to the hit, and from there to its end, over the plane of the triangle
    const auto normal = normal_of(*args, lane);
    const auto slope = glm::dot(normal, direction_of(*args, lane));
    const auto distance = RTCRayN_tfar(args->ray, args->N, lane);
    const auto climb = slope * distance;
    const auto rest = slope * (packet.max_distance[k] - distance);
    const auto least = rule.impl->noise * rule.impl->noise * glm::dot(normal, normal);
    const auto at_start = packet.leaving[k] != no_index && climb * climb < least;
    const auto at_end = packet.arriving[k] != no_index && rest * rest < least;
    if (!at_start && !at_end) continue;
    args->valid[lane] = 0;
    rule.touching |= 1U << k;
  }
}

bool blocked_at_an_end(const Impl& impl, const RayPacket& packet, std::size_t lane, ContactMemory& memory) {
  auto ray = lane_ray(packet, lane);
  const auto extent = static_cast<double>(ray.far) * Vec3(ray.direction);
  if (ray.leaving != no_index) {
    const auto& contacts = remembered_contacts(impl, memory, ray.origin, ray.leaving);
    if (blocked_at_once(impl, contacts, ray, extent)) return true;
  }
  ray.origin += ray.far * ray.direction;
  ray.leaving = packet.arriving[lane];
  return ray.leaving != no_index &&
         blocked_at_once(impl, contacts_of(impl, ray.origin, ray.leaving), ray, -extent);
}

} // namespace

std::uint32_t occluded(const RayScene& rays, const RayPacket& packet, Coherence coherence) {
  const auto& impl = rays.impl();
  RTCRay16 traced;
  alignas(64) const auto valid = traceable_lanes(packet);
  load(lifted_legs(impl.geometry, packet), traced);

  LegRejection context;
  rtcInitIntersectContext(&context);
  context.flags = flags_for(coherence);
  context.filter = reject_ends;
  context.impl = &impl;
  context.packet = &packet;
  rtcOccluded16(valid.data(), impl.scene.get(), &context, &traced);

  // Embree marks what is occluded by a far end of minus infinity.
  LaneFlags met;
  for (std::size_t k = 0; k < packet_size; ++k) met[k] = traced.tfar[k] < 0.0F ? valid[k] : 0;
  auto blocked = bits_of(met);

  const auto open_ends = context.touching & ~blocked;
  if (open_ends == 0) return blocked;
  ContactMemory memory;
  for (auto rest = open_ends; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    if (blocked_at_an_end(impl, packet, k, memory)) blocked |= 1U << k;
  }
  return blocked;
}

// --- Construction

namespace {

void check(RTCDevice device) {
  const auto code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  throw OutputError("", "ray queries",
                    code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory for the triangles of the scene"
                                                    : "Embree cannot be used on this machine");
}

Owned<RTCGeometry, ReleaseGeometry> make_mesh(RTCDevice device, const FrameGeometry& geometry) {
  Owned<RTCGeometry, ReleaseGeometry> mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  check(device);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                              geometry.positions.size()));
  check(device);
  std::ranges::transform(geometry.positions, positions, [](const Point3& x) { return glm::vec3(x); });
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), geometry.triangles.size()));
  check(device);
  std::ranges::copy(geometry.triangles, triangles);
  rtcSetGeometryBuildQuality(mesh.get(), RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(mesh.get());
  check(device);
  return mesh;
}

} // namespace

RayScene::RayScene(const Scene& scene, const SurfaceModel& surfaces) : impl_(std::make_unique<Impl>()) {
  impl_->geometry = make_frame_geometry(scene, surfaces);
  impl_->noise = static_cast<float>(impl_->geometry.noise) + lift;
  impl_->device.reset(rtcNewDevice(nullptr));
  check(impl_->device.get());
  impl_->scene.reset(rtcNewScene(impl_->device.get()));
  check(impl_->device.get());

  // Robust traversal is watertight along shared edges.
  rtcSetSceneFlags(impl_->scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                                  RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
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

RayScene make_ray_scene(const Scene& scene, const SurfaceModel& surfaces) { return {scene, surfaces}; }

} // namespace meninas
