// The rays that a bare query cannot settle, one by one:
// those that start beside a wall, and those that end on a back.
#pragma once

#include "scenes/rays/embree_scene.h"
#include "scenes/rays/hit_rules.h"
#include "scenes/rays/embree_queries.h"

namespace meninas {

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
