#include "scenes/rays/careful_rays.h"

#include <algorithm>

namespace meninas {

namespace {

const Contacts& remembered_contacts(const RayScene& rays, ContactMemory& memory,
                                    const glm::vec3& origin, std::uint32_t leaving) {
  if (memory.origin != origin || memory.leaving != leaving)
    memory = {origin, leaving, contacts_of(rays, origin, leaving)};
  return memory.contacts;
}

/// The contact that blocks what departs from an origin over `extent`:
/// a leg's whole length, or a ray's unit direction.
std::optional<ContactTriangle> blocked_at_once(const RayScene& rays, const Contacts& contacts,
                                               const LaneRay& ray, const Vec3& extent,
                                               bool is_leg) {
  if (contacts.others.empty())
    return std::nullopt;
  const auto& geometry = rays.geometry();
  return blocking_contact(contacts,
                          {Point3(ray.origin), extent, geometry.plane_normals[ray.leaving], is_leg},
                          geometry.noise * double{grain_at(geometry, ray.origin)});
}

LaneHit hit_at_once(const LaneRay& ray, const ContactTriangle& wall) {
  const auto front = glm::dot(area_vector(wall.corners), Vec3(ray.direction)) < 0.0;
  const glm::vec2 weights(nearest_barycentric(wall.corners, Point3(ray.origin)));
  return {index(wall.triangle), 0.0F, weights.x, weights.y, front};
}

/// A back that shares its plane with a front is one side of a sheet,
/// and the side that faces the ray is hit.
LaneHit facing_side(const RayScene& rays, const LaneRay& ray, const LaneHit& back) {
  const auto& geometry = rays.geometry();
  const RayRule rule{.geometry = &geometry,
                     .leaving = &ray.leaving,
                     .backs = BackRule::ignore,
                     .only_plane = geometry.facts[back.triangle].plane};
  auto around = ray;
  around.near = 0.99F * back.distance;
  around.far = std::min(ray.far, 1.01F * back.distance);
  const auto face = trace_one(rays, around, rule);
  return face.triangle == no_index ? back : face;
}

} // namespace

LaneHit careful_hit(const RayScene& rays, const LaneRay& ray, Backs backs, ContactMemory& memory) {
  RayRule rule{.geometry = &rays.geometry(), .leaving = &ray.leaving};
  rule.backs = backs == Backs::transparent ? BackRule::ignore : BackRule::hit;

  // Surfaces that touch the origin are met at distance zero or not at all.
  if (ray.leaving != no_index) {
    const auto& contacts = remembered_contacts(rays, memory, ray.origin, ray.leaving);
    const auto unit = glm::normalize(Vec3(ray.direction));
    if (const auto wall = blocked_at_once(rays, contacts, ray, unit, false)) {
      const auto hit = hit_at_once(ray, *wall);
      if (hit.front || backs == Backs::absorb || wall->sidedness == Sidedness::both)
        return hit;
    }
    rule.contacts = &contacts;
  }

  const auto hit = trace_one(rays, ray, rule);
  if (hit.triangle == no_index || hit.front)
    return hit;
  const auto& facts = rays.geometry().facts[hit.triangle];
  return facts.single_sided && facts.in_sheet ? facing_side(rays, ray, hit) : hit;
}

bool blocked_at_an_end(const RayScene& rays, const LaneRay& leg, std::uint32_t arriving,
                       ContactMemory& memory) {
  const auto extent = static_cast<double>(leg.far) * Vec3(leg.direction);
  if (leg.leaving != no_index) {
    const auto& contacts = remembered_contacts(rays, memory, leg.origin, leg.leaving);
    if (blocked_at_once(rays, contacts, leg, extent, true))
      return true;
  }
  if (arriving == no_index)
    return false;
  auto back = leg;
  back.origin += leg.far * leg.direction;
  back.leaving = arriving;
  return blocked_at_once(rays, contacts_of(rays, back.origin, arriving), back, -extent, true).has_value();
}

} // namespace meninas
