// Rays that go on from a mirror or a lobe: where they start, how far they have come, and which end.
//
// A ray that meets a plane with unit normal n in the direction d goes on in d - 2 (n.d) n.
// On a curved surface n turns from point to point (scenes/shading_normal.h).
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

/// Where lane k meets the exact plane of the face,
/// in the frame of the ray scene, and along which direction.
struct Meeting {
  glm::dvec3 position, direction;
  double distance; ///< metres, for directions of unit length
  double approach; ///< the direction along the normal: negative
  float travelled; ///< up to there, as of SpecularRay
};
Meeting meeting_of(const RenderContext& context, const FaceRecord& face, const RayPacket& packet,
                   const LaneState& state, std::uint32_t k, float distance);

/// The ray of lane k as it leaves that plane,
/// before it is given an origin, a direction, and what it loses there.
SpecularRay ray_from(const LaneState& state, std::uint32_t k, std::uint32_t leaving,
                     std::uint32_t seed);

/// Whether a path that bright is followed, beside what is its due of a camera ray's weight.
inline bool goes_on(const RenderContext& context, std::int32_t bounces, const glm::vec3& throughput,
                    float share) {
  return bounces <= context.settings.max_bounces &&
         largest(throughput) >= context.settings.min_throughput * share;
}

/// Queues a path, unless it is too faint for its share.
void queue_if_visible(const RenderContext& context, const SpecularRay& ray, TileWorkspace& work);

/// Queues the path behind the mirror that the lane has hit,
/// from where it meets the mirror's exact plane.
void reflect(const LandedLane& lane, TileWorkspace& work);

} // namespace meninas
