// The rays that a bare query cannot settle, one by one:
// those that start beside a wall, and those that end on a back.
#pragma once

#include "scenes/rays/hit_rules.h"

namespace meninas {

// --- What the ray scene offers for it (ray_scene.cpp)

LaneHit trace_one(const RayScene& rays, const LaneRay& ray, const RayRule& rule);

/// The triangles within reach of a point that leaves a plane,
/// or nearer than `least_reach` times its grain if that is further.
Contacts contacts_of(const RayScene& rays, const glm::vec3& origin, std::uint32_t leaving,
                     double least_reach = 0.0);

// --- What is made of it

/// Adds a triangle within reach, once, of a point that leaves a plane.
void add_contact(const FrameGeometry& geometry, std::uint32_t triangle, std::uint32_t leaving,
                 Contacts& contacts);

/// The contacts of the last origin asked for: the rays of a packet often share theirs.
struct ContactMemory {
  glm::vec3 origin{std::numeric_limits<float>::quiet_NaN()};
  std::uint32_t leaving = no_index;
  Contacts contacts;
};

LaneHit careful_hit(const RayScene& rays, const LaneRay& ray, Backs backs, ContactMemory& memory);

/// Whether a triangle that touches an end of the leg stands in its way.
bool blocked_at_an_end(const RayScene& rays, const LaneRay& leg, std::uint32_t arriving,
                       ContactMemory& memory);

} // namespace meninas
