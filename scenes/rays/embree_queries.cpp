#include "scenes/rays/embree_queries.h"

#include "scenes/rays/embree_filters.h"
#include "scenes/rays/embree_handles.h"

#include <algorithm>
#include <utility>

namespace meninas {

namespace {

/// Adds a triangle within reach of a point that leaves a plane.
void add_contact(const FrameGeometry& geometry, std::uint32_t triangle, std::uint32_t leaving,
                 Contacts& contacts) {
  const auto& facts = geometry.facts[triangle];
  // What touches glass is not blocked by it.
  if (facts.glass && facts.plane != leaving)
    return;
  auto& list = facts.plane == leaving ? contacts.own : contacts.others;
  list.push_back({TriangleId{triangle}, PlaneId{facts.plane},
                  facts.single_sided ? Sidedness::single : Sidedness::both, facts.glass,
                  corners_of(geometry, triangle)});
}

struct ContactQuery {
  const FrameGeometry* geometry;
  Point3 origin;
  std::uint32_t leaving;
  double reach;
  Contacts found;
};

/// The tree holds parts of large triangles apart, so that some are found more than once. Hundreds meet in the
/// middle of a fan: to look for each in all others would take longer than to find them.
void remove_repeated(std::vector<ContactTriangle>& contacts) {
  std::ranges::sort(contacts, {}, &ContactTriangle::triangle);
  const auto repeated = std::ranges::unique(contacts, {}, &ContactTriangle::triangle);
  contacts.erase(repeated.begin(), repeated.end());
}

bool collect_contact(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<ContactQuery*>(args->userPtr);
  if (is_within(corners_of(*query.geometry, args->primID), query.origin, query.reach))
    add_contact(*query.geometry, args->primID, query.leaving, query.found);
  return false;
}

} // namespace

Contacts contacts_of(const RayScene& rays, const glm::vec3& origin, std::uint32_t leaving,
                     double min_reach) {
  ContactQuery query{&rays.geometry(), Point3(origin), leaving, std::max(contact_reach, min_reach), {}};
  query.reach *= double{grain_at(rays.geometry(), origin)};
  RTCPointQuery point{origin.x, origin.y, origin.z, 0.0F, static_cast<float>(2.0 * query.reach)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(rays.impl().scene.get(), &point, &context, collect_contact, &query);
  remove_repeated(query.found.own);
  remove_repeated(query.found.others);
  return std::move(query.found);
}

static RTCRayHit query_of(const LaneRay& ray) {
  const auto& [origin, direction, near, far, leaving] = ray;
  RTCRayHit query{};
  query.ray = {origin.x,    origin.y, origin.z, near, direction.x, direction.y,
               direction.z, 0.0F,     far,      ~0U,  0U,          0U};
  query.hit.primID = no_index;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

LaneHit trace_one(const RayScene& rays, const LaneRay& ray, const RayRule& rule) {
  RTCRayHit query = query_of(ray);
  auto context = make_context(rule, Coherence::incoherent);
  trace(rays.impl().scene.get(), context, query);
  const glm::vec3 normal{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
  return {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v,
          glm::dot(normal, ray.direction) < 0.0F};
}

void trace_all(const RayScene& rays, const LaneRay& ray, const RayRule& rule,
               std::vector<LaneHit>& hits) {
  hits.clear();
  RTCRayHit query = query_of(ray);
  auto context = make_context(rule, hits);
  trace(rays.impl().scene.get(), context, query);
  // Where triangles lie in several boxes of the tree, a search may find one more than once.
  const auto place = [](const LaneHit& hit) { return std::pair(hit.distance, hit.triangle); };
  std::ranges::sort(hits, {}, place);
  const auto again = std::ranges::unique(hits, {}, place);
  hits.erase(again.begin(), again.end());
}

} // namespace meninas
