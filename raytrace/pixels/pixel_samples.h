// Camera rays of a tile: stratified points of every pixel (Sobol's sequence, scrambled), sixteen at a
// time, traced and shaded.
#pragma once

#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

/// Coordinate d of the stratified points of a pixel that have these numbers.
std::vector<std::uint32_t> pixel_net(const SampleRange& range, std::size_t d);

/// Traces and shades the camera rays of the tile, pixel by pixel.
void trace_camera_rays(const RenderContext& context, const TileArea& tile, TileWorkspace& work);

} // namespace meninas
