// The state of the lanes of a packet: pixel and sample of camera rays, the path so far of specular rays.
#pragma once

#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

namespace meninas {

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

/// The data of the rays of a packet: for camera rays their pixel and sample and the mirrors they have met
/// together; for specular rays their record.
struct LaneState {
  const std::uint32_t* pixel;
  const SpecularRay* specular; ///< of lane 0; null for camera rays
  const std::uint32_t*
      sample; ///< numbers that tell the samples of a pixel apart; null for specular rays
  const std::uint32_t* number;      ///< of the sample in its pixel; null for specular rays
  const MirrorBeam* beam = nullptr; ///< of camera rays behind mirrors

  /// The key of the samples taken where lane k lands.
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
inline const FaceRecord& face_of(const ElementLookup& landing, const HitPacket& hits,
                                 std::uint32_t k) {
  return landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
}

} // namespace meninas
