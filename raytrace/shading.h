// Shading of the surfaces that rays have met: the field's radiance, W/m^2/sr, is added to their pixels, and
// mirrors queue the rays that go on.
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                  const HitPacket& hits, TileWorkspace& work);

/// The same of a full packet whose rays have all met one face, or nothing.
void shade_alike(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                 const HitPacket& hits, TileWorkspace& work);

} // namespace meninas
