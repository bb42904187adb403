// Pixels whose camera rays certainly all take the same path, by the same mirrors to the same face:
// these rays need not be traced.
//
// The rays of a block of pixels are a reflection frustum. Where a face covers it, and whatever
// else reaches into it lies behind the plane of the face, all rays of the block meet it.
// If it is a mirror, the frustum is reflected and asked the same behind it.
// A block that is not sure of its path is divided, down to a few rays, which are traced then.
// Which faces reach into the frustum of a tile is found once for every leg (frustum.h),
// with how its rays see them (face_view.h), and each block sorts out those of its parent.
//
// The unfolded ray through the point (x, y) of the picture is o + t d, o and d affine in (x, y),
// one of them constant. It lands where n . (o + t d) = c, so that the weights of a triangle's
// corners there are ratios of affine functions of x and y: nothing else is left to compute.
#pragma once

#include "raytrace/beams/face_view.h"

#include <vector>

namespace meninas {

struct RenderContext;
struct TileArea;

/// A face that reaches into the frustum of the tile.
struct FrustumPiece {
  const FrustumFace* face;
  FaceView view;
};

/// The rays of a tile behind a chain of mirrors, and what is there.
struct FrustumLeg {
  PictureRays rays;     ///< at (x, y) pixels of the tile
  double longest = 0.0; ///< of their directions
  std::uint32_t leaving = index(none<PlaneId>);
  std::uint32_t parent = 0;
  std::int32_t mirrors = 0;
  glm::vec3 throughput{1.0F};
  std::uint32_t first = 0, last = 0; ///< pieces
};

/// What all camera rays of some pixels come to.
struct SurePath {
  std::uint32_t leg = 0;
  std::uint32_t triangle = index(none<TriangleId>); ///< of the face, or nothing
  bool front = true;
  std::int32_t mirrors = 0;
  glm::vec3 throughput{1.0F}; ///< of the mirrors
  glm::vec2 corner{0.0F};     ///< of the tile in the picture
  /// Times (1, x - corner.x, y - corner.y):
  /// the weights of the triangle's second and third corner, times what the last gives.
  glm::vec3 b1{0.0F}, b2{0.0F}, over{1.0F};
};

/// The paths of a tile, and storage to find them.
struct SurePaths {
  static constexpr std::uint16_t unknown = 0xffff;

  std::vector<SurePath> paths;
  std::vector<std::uint16_t> path_of; ///< by pixel of the tile
  std::vector<FrustumLeg> legs;
  std::vector<FrustumPiece> pieces;
  std::vector<std::uint32_t> in_block; ///< pieces of the block in hand, after those of its parents
};

/// To look at a face takes about as long as to trace a few rays.
inline constexpr std::size_t rays_to_a_face = 4;
/// Where more than one of so many rays comes near a face, little is certain.
inline constexpr std::size_t rays_to_a_piece = 64;

/// Clears and fills `sure`.
void find_sure_paths(const RenderContext& context, const TileArea& tile, SurePaths& sure);

/// Where the rays at (x, y) of the picture land.
void land_surely(const SurePath& path, const std::array<float, packet_size>& x,
                 const std::array<float, packet_size>& y, HitPacket& hits);

} // namespace meninas
