// The paths of a tile whose ways are certain (coherent_beams.h): frusta behind chains of mirrors, the
// faces that reach into them, and the barycentrics b = (b1, b2) / over, linear in the pixel (x, y).
#pragma once

#include "raytrace/beams/face_view.h"

#include <vector>

namespace meninas {

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

/// The path and the hit that all camera rays of some pixels share.
struct CoherentBeam {
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
struct CoherentBeams {
  static constexpr std::uint16_t unknown = 0xffff;

  std::vector<CoherentBeam> paths;
  std::vector<std::uint16_t> path_of; ///< by pixel of the tile
  std::vector<FrustumLeg> legs;
  std::vector<FrustumPiece> pieces;
  std::vector<std::uint32_t> in_block; ///< pieces of the block in hand, after those of its parents
};

} // namespace meninas
