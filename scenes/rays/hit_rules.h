// The rules behind Embree's filters, which decide whether a triangle it finds is a hit. They are free of Embree.
#pragma once

#include "scenes/rays/ray_contacts.h"
#include "scenes/rays/lanes.h"

#include <algorithm>

namespace meninas {

/// A triangle that a ray is about to hit.
struct Candidate {
  std::uint32_t triangle = no_index;
  std::uint32_t lane = 0;
  glm::vec3 normal; ///< towards the front, of any length
  glm::vec3 direction;
  float distance = 0.0F;
};

enum class BackRule { hit, ignore };

/// A ray hits nothing in the plane it leaves nor in the planes of the triangles
/// that touch its origin, and no backs where they are ignored.
/// Where only one plane, or only glass, is looked for, it hits nothing else.
struct RayRule {
  const FrameGeometry* geometry = nullptr;
  const std::uint32_t* leaving = nullptr; ///< by lane
  const Contacts* contacts = nullptr;
  BackRule backs = BackRule::hit;
  std::uint32_t only_plane = no_index;
  bool only_glass = false;
};

inline bool is_contact(const Contacts* contacts, std::uint32_t plane) {
  return contacts && std::ranges::any_of(contacts->others, [&](const ContactTriangle& contact) {
           return index(contact.plane) == plane;
         });
}

inline bool is_hit(const RayRule& rule, const Candidate& candidate) {
  const auto& facts = rule.geometry->facts[candidate.triangle];
  if (facts.plane == rule.leaving[candidate.lane] || is_contact(rule.contacts, facts.plane))
    return false;
  if (rule.only_plane != no_index && facts.plane != rule.only_plane)
    return false;
  if (rule.only_glass && !facts.glass)
    return false;
  const auto back = glm::dot(candidate.normal, candidate.direction) >= 0.0F;
  return rule.backs == BackRule::hit || !facts.single_sided || !back;
}

/// A leg is not blocked by glass, unless solids are opaque to it, nor in the planes it
/// leaves and arrives at; triangles in whose plane an end lies are left to its contacts.
struct LegRule {
  const FrameGeometry* geometry = nullptr;
  const RayPacket* packet = nullptr;
  float noise = 0.0F; ///< times the grain of an end: not higher over a plane it lies in it
  Solids solids = Solids::sheets;
};

enum class LegHit { blocking, own, touching };

inline LegHit leg_hit(const LegRule& rule, const Candidate& candidate) {
  const auto& facts = rule.geometry->facts[candidate.triangle];
  const auto plane = facts.plane;
  const auto leaving = rule.packet->leaving[candidate.lane];
  const auto arriving = rule.packet->arriving[candidate.lane];
  const bool passed = facts.glass && !(facts.solid && rule.solids == Solids::opaque);
  if (plane == leaving || plane == arriving || passed)
    return LegHit::own;

  // The climb of the leg from its start to the hit,
  // and from there to its end, over the plane of the triangle
  const auto slope = glm::dot(candidate.normal, candidate.direction);
  const auto climb = slope * candidate.distance;
  const auto rest = slope * (rule.packet->max_distance[candidate.lane] - candidate.distance);
  const LaneRay leg = lane_ray(*rule.packet, candidate.lane);
  const auto least = rule.noise * rule.noise * glm::dot(candidate.normal, candidate.normal);
  const auto is_rounding = [&](float height, const glm::vec3& end) {
    const auto beside_grain = height / grain_at(*rule.geometry, end);
    return beside_grain * beside_grain < least;
  };
  const auto at_start = leaving != no_index && is_rounding(climb, leg.origin);
  const auto at_end =
      arriving != no_index && is_rounding(rest, leg.origin + leg.far * leg.direction);
  return at_start || at_end ? LegHit::touching : LegHit::blocking;
}

/// Judges the hits of a packet of legs, and keeps what they were.
struct LegJudge {
  LegRule rule;
  std::uint32_t touching = 0;   ///< lanes with a hit that touches an end
  Blockers* blockers = nullptr; ///< by lane; null: not asked for

  bool blocks(const Candidate& candidate) {
    const auto verdict = leg_hit(rule, candidate);
    if (verdict == LegHit::touching)
      touching |= 1U << candidate.lane;
    if (verdict == LegHit::blocking && blockers)
      (*blockers)[candidate.lane] = candidate.triangle;
    return verdict == LegHit::blocking;
  }
};

} // namespace meninas
