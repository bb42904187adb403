// What a tile of the picture is made with: what all tiles share, and the storage of one.
#pragma once

#include "raytrace/camera_rays.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/render.h"
#include "scenes/sampling.h"

#include <array>
#include <vector>

namespace meninas {

/// A pixel's radiance by how it is seen: straight, in one mirror, by way of several.
inline constexpr std::size_t seen_ways = 3;
using SeenRadiance = std::array<glm::vec3, seen_ways>;

/// A specular path that goes on: where, in which pixel of the tile, with what throughput.
struct SpecularRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  glm::vec3 throughput;
  std::uint32_t pixel;
  std::uint32_t leaving;
  std::uint32_t key; ///< of its samples
  float travelled;   ///< from the eye, unfolded, in units of the camera direction's length
};

struct TileWorkspace {
  std::array<std::vector<glm::vec3>, seen_ways>
      sums;            ///< by way of seeing, then by pixel of the tile
  std::size_t way = 0; ///< that of the rays under way
  std::vector<SpecularRay> current, next;
  PointWorkspace point; ///< of diffuse terms computed at the hit
  std::uint64_t camera_rays = 0, specular_rays = 0;
};

struct TileArea {
  int x0, y0, width, height;
};

/// 1 for pixels that are meant, row by row.
using PixelMask = std::vector<std::uint8_t>;

/// Samples by their number: any first 2^k of a pixel are stratified, and so are the 2^k after 2^k.
struct SampleRange {
  int first = 0, count = 1;
};

/// Everything the tiles share.
struct RenderContext {
  const LightScene& light;
  const VisibleLight& visible;
  const PointGathering* gathering; ///< of the diffuse term `gather`, else null
  const RenderSettings& settings;
  CameraFrame camera;
  std::vector<std::uint32_t> net_x, net_y; ///< stratified points of the pixel, as integers
  const PixelMask* chosen = nullptr;       ///< pixels of the picture to be traced; null: all
  const FilterPlaces* filter = nullptr;    ///< null: the box, whose points are where they are
  double footprint_samples = 1.0;          ///< that share a pixel in all parts of the picture
};

inline bool is_chosen(const RenderContext& context, int x, int y) {
  return !context.chosen || (*context.chosen)[static_cast<std::size_t>(y) *
                                                  static_cast<std::size_t>(context.settings.width) +
                                              static_cast<std::size_t>(x)] != 0;
}

/// What the rays of a packet carry: camera rays nothing but their pixel, specular rays their record.
struct LaneState {
  const std::uint32_t* pixel;
  const SpecularRay* specular;  ///< of lane 0; null for camera rays
  const std::uint32_t* sample; ///< numbers that tell the samples of a pixel apart; null for specular rays
  
  /// Of the samples taken where lane k lands.
  std::uint32_t key(std::uint32_t k, std::uint32_t seed) const {
    return specular ? specular[k].key : hash(sample[k], pixel[k], seed);
  }
};

/// The face of its triangle that lane k has hit.
inline const FaceRecord& face_of(const LandingTable& landing, const HitPacket& hits,
                                 std::uint32_t k) {
  return landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
}

} // namespace meninas
