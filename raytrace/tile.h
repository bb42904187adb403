// What a tile of the picture is made with: what all tiles share, and the storage of one.
#pragma once

#include "radiosity/light/light_samples.h"
#include "raytrace/pixels/camera_rays.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/lobe_grid.h"
#include "raytrace/render_settings.h"
#include "raytrace/beams/coherent_beam.h"
#include "scenes/sampling.h"

#include <algorithm>
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
  float share = 1.0F; ///< of a camera ray's weight: 1 / n^2 for each of the n x n rays of a lobe
  std::uint32_t pixel;
  std::uint32_t leaving;
  std::uint32_t key;        ///< of its samples
  std::uint32_t number;     ///< of its camera ray among those of the pixel
  std::uint16_t lobes = 0;  ///< that it has gone through
  float travelled = 0.0F;   ///< from the eye, unfolded, in units of the camera direction's length
  std::uint16_t way = 0;    ///< how its pixel sees what it meets: index into SeenRadiance
  std::int32_t bounces = 0; ///< off mirrors and in lobes; what goes through glass is none
  // Since it left a lobe whose emitters are sampled as well (scattering.h):
  float density = 0.0F; ///< of the directions of that lobe's rays, per steradian; 0: there is none
  float since_lobe = 0.0F;              ///< metres
  MaterialId medium = none<MaterialId>; ///< the solid it has been refracted into
  WorldId world = none<WorldId>;
};

struct TileArea {
  int x0, y0, width, height;
};

/// The way of seeing behind that many mirrors more.
inline std::uint16_t more_mirrors(std::uint16_t way, int mirrors) {
  return static_cast<std::uint16_t>(std::min(way + mirrors, int{seen_ways - 1}));
}
inline std::uint16_t one_more_mirror(std::uint16_t way) { return more_mirrors(way, 1); }

struct TileWorkspace {
  std::array<std::vector<glm::vec3>, seen_ways>
      sums; ///< by way of seeing, then by pixel of the tile
  std::vector<SpecularRay> current, next;
  CoherentBeams sure;
  TileArea area{};
  std::vector<LobeRay> lobe;
  std::vector<PunctualArrival> highlights;
  std::vector<EmissionSample> lamps;
  PointWorkspace point;        ///< of diffuse terms computed at the hit
  std::uint64_t camera_rays = 0, specular_rays = 0;
  std::uint64_t sure_rays = 0; ///< of these, not traced
};

/// A seed of the pixel's own, wherever tiles begin.
inline std::uint32_t pixel_seed(const TileArea& area, std::uint32_t pixel, std::uint32_t seed) {
  const auto width = static_cast<std::uint32_t>(area.width);
  return hash(static_cast<std::uint32_t>(area.x0) + pixel % width,
              static_cast<std::uint32_t>(area.y0) + pixel / width, hash(seed, 0x10be));
}

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
  double footprint_samples = 1.0;          ///< that share a pixel: these and those before
  std::uint32_t first_sample = 0;          ///< number of the first of these points
  std::vector<Bsdf>
      bsdfs; ///< by MaterialId, of those with lobes and without textures; empty where none has lobes
  DiffuseSettings behind_lobes; ///< where many rays of a pixel land by way of one
  std::vector<std::uint8_t>
      blurred; ///< by WorldId: 1 where one of its mirrors has a lobe of its own, which rays follow
  std::vector<FrustumFace> frustum_faces; ///< for coherent_beams.h; empty: all rays are traced
  std::vector<std::uint32_t> net_u, net_v; ///< likewise of the lens; empty where there is none
};

inline bool is_chosen(const RenderContext& context, int x, int y) {
  return !context.chosen || (*context.chosen)[static_cast<std::size_t>(y) *
                                                  static_cast<std::size_t>(context.settings.width) +
                                              static_cast<std::size_t>(x)] != 0;
}

/// Sixteen camera rays behind the mirrors that all of them have met (packet_reflection.h),
/// in the frame of the ray scene.
struct alignas(64) MirrorBeam {
  double origin_x[packet_size], origin_y[packet_size], origin_z[packet_size];
  double direction_x[packet_size], direction_y[packet_size], direction_z[packet_size];
  float travelled[packet_size]; ///< as of SpecularRay
  glm::vec3 throughput{1.0F};
  std::uint16_t way = 0;    ///< as of SpecularRay
  std::int32_t bounces = 0; ///< off mirrors
};

/// What the rays of a packet carry: camera rays their pixel and sample,
/// and what mirrors they have met together; specular rays their record.
struct LaneState {
  const std::uint32_t* pixel;
  const SpecularRay* specular; ///< of lane 0; null for camera rays
  const std::uint32_t*
      sample; ///< numbers that tell the samples of a pixel apart; null for specular rays
  const std::uint32_t* number;      ///< of the sample in its pixel; null for specular rays
  const MirrorBeam* beam = nullptr; ///< of camera rays behind mirrors

  /// Of the samples taken where lane k lands.
  std::uint32_t key(std::uint32_t k, std::uint32_t seed) const {
    return specular ? specular[k].key : hash(sample[k], pixel[k], seed);
  }
  std::size_t way(std::uint32_t k) const {
    return specular ? specular[k].way : beam ? beam->way : 0;
  }
  glm::vec3 throughput(std::uint32_t k) const {
    return specular ? specular[k].throughput : beam ? beam->throughput : glm::vec3(1.0F);
  }
  float travelled(std::uint32_t k) const {
    return specular ? specular[k].travelled : beam ? beam->travelled[k] : 0.0F;
  }
  std::uint32_t number_of(std::uint32_t k) const {
    return specular ? specular[k].number : number[k];
  }
};

/// Lane k of a packet where it has met a face, with what it carries and what all tiles share.
struct LandedLane {
  const RenderContext& context;
  const RayPacket& packet;
  const LaneState& state;
  const FaceRecord& face;
  const HitPacket& hits;
  std::uint32_t k;
};

/// The face of its triangle that lane k has hit.
inline const FaceRecord& face_of(const LandingTable& landing, const HitPacket& hits,
                                 std::uint32_t k) {
  return landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
}

} // namespace meninas
