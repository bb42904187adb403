// The surface on which a lane of a packet has landed: where light is received, and how it is reflected.
//
//   L = L_e + (rho H + tau H_behind) / pi        W/m^2/sr
//
// with H the irradiance there and, of translucent surfaces, H_behind that of the other side, W/m^2.
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

/// The normal by which the surface reflects light towards `out`, a direction above the face.
/// It turns with a curved surface (scenes/shading_normal.h).
Direction normal_towards(const LandedLane& lane, const Direction& out);

/// Where lane k has landed, as one who receives light there: of a curved surface, on the curve.
Receiver receiver_at(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                     std::uint32_t k);

/// The shading of the surface where the lane has landed: of the very point if it is textured, in the part of the
/// light that is shown.
SideShading shading_at(const LandedLane& lane);

/// H where lane k has landed on a side.
glm::vec3 irradiance_of_lane(const RenderContext& context, const LaneState& state,
                             const FaceRecord& face, const HitPacket& hits, std::uint32_t k,
                             TileWorkspace& work);

/// H of the other side there; 0 where that is none.
glm::vec3 irradiance_behind(const LandedLane& lane, TileWorkspace& work);

/// L_e + (rho H + tau H_behind) / pi where the lane has landed on a side, rho as in pass one.
glm::vec3 radiance_of_lane(const LandedLane& lane, TileWorkspace& work);

} // namespace meninas
