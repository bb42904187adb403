// Pixels whose camera rays certainly all take the same path, by the same mirrors to the same face:
// these rays need not be traced.
//
// The rays of a block of pixels are a reflection frustum. Where a face covers it, and whatever
// else reaches into it lies behind the plane of the face, all rays of the block meet it.
// If it is a mirror, the frustum is reflected and asked the same behind it.
// A block that is not sure of its path is divided, down to a few rays, which are traced then.
// The faces that reach into the frustum of a tile are found once for every leg (frustum.h),
// with their view from its rays (face_view.h), and each block sorts out those of its parent.
//
// The unfolded ray through the point (x, y) of the picture is o + t d, o and d affine in (x, y),
// one of them constant. It lands where n . (o + t d) = c, so that the weights of a triangle's
// corners there are ratios of affine functions of x and y: nothing else is left to compute.
#pragma once

#include "raytrace/beams/coherent_beam.h"

namespace meninas {

struct RenderContext;
struct TileArea;

/// To look at a face takes about as long as to trace a few rays.
inline constexpr std::size_t rays_to_a_face = 4;
/// Where more than one of so many rays comes near a face, little is certain.
inline constexpr std::size_t rays_to_a_piece = 64;

/// Clears and fills `sure`.
void find_coherent_beams(const RenderContext& context, const TileArea& tile, CoherentBeams& sure);

/// Where the rays at (x, y) of the picture land.
void land_surely(const CoherentBeam& path, const std::array<float, packet_size>& x,
                 const std::array<float, packet_size>& y, HitPacket& hits);

} // namespace meninas
