// Lamps in a lobe are found by its rays and by points on the lamps: each counts by its share.
//
//   w = p / (p + q)     the balance heuristic (Veach, Guibas 1995)
//
// p is the density per steradian with which rays of the lobe find the direction, q that of the points.
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"

namespace meninas {

/// N for each emitter's image.
int points_per_lamp(const RenderContext& context);

/// The share p / (p + q) in which lane k shows the emission of a side: 1 where no points are on it.
float share_of_rays(const RenderContext& context, const LaneState& state, const FaceRecord& face,
                    const HitPacket& hits, std::uint32_t k);

/// Adds to the pixels what rays show of area lights on their way to what they hit, by the same shares.
/// Such lights are no faces: nothing else meets them.
void show_area_lights(const RenderContext& context, const LaneState& state, std::uint32_t count,
                      const HitPacket& hits, TileWorkspace& work);

/// q of so many points on a lamp of that area, which are seen at this distance under this cosine.
double density_of_points(int points, double distance, double cosine, double area);

} // namespace meninas
