// Sixteen camera rays that meet the same mirrors, one after the other:
// a reflection frustum of a pixel, or of a few.
//
// As long as all of them meet one mirror they are reflected side by side,
// without a record for each (SpecularRay), and traced as the packet that they are.
// Where they part, what they have met tells (shade_packet): those that go on are queued one by one.
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

/// Traces a packet of camera rays from mirror to mirror while they stay together,
/// and shades what they meet where they part.
void trace_together(const RenderContext& context, RayPacket& packet, LaneState state,
                    TileWorkspace& work);

/// Shades what a packet of camera rays has come to by a path that was known (coherent_beams.h).
void shade_behind_mirrors(const RenderContext& context, const RayPacket& packet, LaneState state,
                          const CoherentBeam& path, const HitPacket& hits, TileWorkspace& work);

} // namespace meninas
