// The lanes of a packet:
// which are rays, where they really start, and which of them a bare query cannot settle.
#pragma once

#include "scenes/rays/frame_geometry.h"

namespace meninas {

inline constexpr auto no_index = std::numeric_limits<std::uint32_t>::max();

// The frame maps the scene into [-1, 1], where floats are rounded by at most 3e-8 per coordinate.
// Origins are lifted off the plane they leave by `lift`, a few such roundings, times the grain
// of the place (frame_geometry.h), so that the plane is hardly ever hit again;
// where it is, the query is repeated with a filter that knows the plane.
inline constexpr float lift = 1e-6F;

struct LaneRay {
  glm::vec3 origin;
  glm::vec3 direction;
  float near = 0.0F;
  float far = std::numeric_limits<float>::infinity();
  std::uint32_t leaving = no_index;
};

struct LaneHit {
  std::uint32_t triangle = no_index;
  float distance = std::numeric_limits<float>::infinity();
  float b1 = 0.0F, b2 = 0.0F;
  bool front = true;
};

LaneRay lane_ray(const RayPacket& packet, std::size_t lane);
void store(HitPacket& hits, std::size_t lane, const LaneHit& hit);

using LaneFlags = std::array<std::int32_t, packet_size>; ///< -1 where it holds, as Embree wants it

/// 2^k by lane, from a table: few processors shift by lane.
inline constexpr auto lane_bits = [] {
  std::array<std::uint32_t, packet_size> bits{};
  for (std::uint32_t k = 0; k < packet_size; ++k)
    bits[k] = 1U << k;
  return bits;
}();

/// Bit k is set where flag k is.
inline std::uint32_t bits_of(const LaneFlags& flags) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < packet_size; ++k)
    bits |= static_cast<std::uint32_t>(flags[k]) & lane_bits[k];
  return bits;
}

/// The lanes that are rays: below the count, finite, with a direction and a length.
LaneFlags traceable_lanes(const RayPacket& packet);

/// A vector per lane.
struct alignas(64) LaneVectors {
  float x[packet_size], y[packet_size], z[packet_size];
};

bool leaves_nothing(const RayPacket& packet);

/// The origins of a packet moved off the planes they leave, towards the side their ray goes to.
LaneVectors lifted_origins(const FrameGeometry& geometry, const RayPacket& packet);

/// The directions from lifted origins to the ends of legs moved off the planes they arrive at,
/// towards the side they come from.
LaneVectors lifted_directions(const FrameGeometry& geometry, const RayPacket& packet,
                              const LaneVectors& origins);

struct Doubts {
  std::uint32_t careful = 0;    ///< lanes to be traced again one by one
  std::uint32_t at_contact = 0; ///< lanes to be traced again if anything else touches their origin
  std::uint32_t through = 0;    ///< lanes that met a transparent back
};

/// The lanes that a bare query cannot settle. Rays that leave a surface: hits in the plane they leave, hits
/// that touch their origin and, where the origin may lie a hair behind another surface, misses and backs.
/// All rays: backs of sheets.
Doubts find_doubts(const FrameGeometry& geometry, const RayPacket& packet, const HitPacket& hits,
                   const LaneFlags& valid, const LaneFlags& touching, Backs backs);

} // namespace meninas
