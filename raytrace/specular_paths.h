// Specular paths: what a mirror sends on, and the tile's rays followed from mirror to mirror.
//
// A path ends where it lands on the field, escapes,
// or when its throughput falls below `RenderSettings::min_throughput`.
#pragma once

#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

/// Traces what is queued, bounce after bounce, until nothing is left.
void follow_mirrors(const RenderContext& context, TileWorkspace& work);

} // namespace meninas
