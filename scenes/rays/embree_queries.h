// One ray, and the surroundings of one point: what careful rays are made of (careful_rays.h).
#pragma once

#include "scenes/rays/embree_scene.h"
#include "scenes/rays/hit_rules.h"

#include <vector>

namespace meninas {

LaneHit trace_one(const RayScene& rays, const LaneRay& ray, const RayRule& rule);

/// Everything that the ray meets by the rule, nearest first, whatever is before it: one search finds all.
/// Clears and fills `hits`.
void trace_all(const RayScene& rays, const LaneRay& ray, const RayRule& rule,
               std::vector<LaneHit>& hits);

/// The triangles within reach of a point that leaves a plane,
/// or nearer than `min_reach` times its grain if that is further.
Contacts contacts_of(const RayScene& rays, const glm::vec3& origin, std::uint32_t leaving,
                     double min_reach = 0.0);

} // namespace meninas
