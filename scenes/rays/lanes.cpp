#include "scenes/rays/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

namespace {

bool all_equal(const std::uint32_t* planes) {
  std::uint32_t differences = 0;
  for (std::size_t k = 1; k < packet_size; ++k)
    differences |= planes[k] ^ planes[0];
  return differences == 0;
}

/// The normals of the planes of a packet's lanes, zero where there is none.
LaneVectors lane_normals(const FrameGeometry& geometry, const std::uint32_t* planes) {
  const auto no_plane = static_cast<std::uint32_t>(geometry.lifts.size() - 1);
  LaneVectors normals;
  if (all_equal(planes)) {
    const auto& n = geometry.lifts[std::min(planes[0], no_plane)];
    std::fill_n(normals.x, packet_size, n.x);
    std::fill_n(normals.y, packet_size, n.y);
    std::fill_n(normals.z, packet_size, n.z);
    return normals;
  }
  for (std::size_t k = 0; k < packet_size; ++k) {
    const auto& n = geometry.lifts[std::min(planes[k], no_plane)];
    normals.x[k] = n.x;
    normals.y[k] = n.y;
    normals.z[k] = n.z;
  }
  return normals;
}

} // namespace

LaneRay lane_ray(const RayPacket& packet, std::size_t lane) {
  return {{packet.origin_x[lane], packet.origin_y[lane], packet.origin_z[lane]},
          {packet.direction_x[lane], packet.direction_y[lane], packet.direction_z[lane]},
          0.0F,
          packet.max_distance[lane],
          packet.leaving[lane]};
}

void store(HitPacket& hits, std::size_t lane, const LaneHit& hit) {
  hits.triangle[lane] = hit.triangle;
  hits.distance[lane] = hit.distance;
  hits.b1[lane] = hit.b1;
  hits.b2[lane] = hit.b2;
  hits.front[lane] = hit.front ? 1 : 0;
}

LaneFlags traceable_lanes(const RayPacket& packet) {
  constexpr auto infinity = std::numeric_limits<float>::infinity();
  LaneFlags flags;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const auto steps = std::abs(packet.direction_x[k]) + std::abs(packet.direction_y[k]) +
                       std::abs(packet.direction_z[k]);
    const auto place =
        std::abs(packet.origin_x[k]) + std::abs(packet.origin_y[k]) + std::abs(packet.origin_z[k]);
    const auto is_ray =
        (steps > 0.0F) & (steps < infinity) & (place < infinity) & (packet.max_distance[k] > 0.0F);
    flags[k] = is_ray ? -1 : 0;
  }
  for (std::size_t k = packet.count; k < packet_size; ++k)
    flags[k] = 0;
  return flags;
}

bool leaves_nothing(const RayPacket& packet) {
  return packet.leaving[0] == no_index && all_equal(packet.leaving);
}

LaneVectors lifted_origins(const FrameGeometry& geometry, const RayPacket& packet) {
  const auto n = lane_normals(geometry, packet.leaving);
  LaneVectors lifted;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const auto slope = n.x[k] * packet.direction_x[k] + n.y[k] * packet.direction_y[k] +
                       n.z[k] * packet.direction_z[k];
    const auto grain =
        grain_at(geometry, packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]);
    const auto side = std::copysign(lift * grain, slope);
    lifted.x[k] = packet.origin_x[k] + side * n.x[k];
    lifted.y[k] = packet.origin_y[k] + side * n.y[k];
    lifted.z[k] = packet.origin_z[k] + side * n.z[k];
  }
  return lifted;
}

LaneVectors lifted_directions(const FrameGeometry& geometry, const RayPacket& packet,
                              const LaneVectors& origins) {
  const auto n = lane_normals(geometry, packet.arriving);
  LaneVectors lifted;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const auto slope = n.x[k] * packet.direction_x[k] + n.y[k] * packet.direction_y[k] +
                       n.z[k] * packet.direction_z[k];
    const auto far = packet.max_distance[k];
    const auto grain = grain_at(geometry, packet.origin_x[k] + far * packet.direction_x[k],
                                packet.origin_y[k] + far * packet.direction_y[k],
                                packet.origin_z[k] + far * packet.direction_z[k]);
    const auto side = -std::copysign(lift * grain, slope);
    const auto share = 1.0F / packet.max_distance[k];
    lifted.x[k] =
        packet.direction_x[k] + share * (side * n.x[k] + packet.origin_x[k] - origins.x[k]);
    lifted.y[k] =
        packet.direction_y[k] + share * (side * n.y[k] + packet.origin_y[k] - origins.y[k]);
    lifted.z[k] =
        packet.direction_z[k] + share * (side * n.z[k] + packet.origin_z[k] - origins.z[k]);
  }
  return lifted;
}

Doubts find_doubts(const FrameGeometry& geometry, const RayPacket& packet, const HitPacket& hits,
                   const LaneFlags& valid, const LaneFlags& touching, Backs backs) {
  LaneFlags missed, turned, leaves, own;
  for (std::size_t k = 0; k < packet_size; ++k)
    missed[k] = valid[k] & (hits.triangle[k] == no_index ? -1 : 0);
  for (std::size_t k = 0; k < packet_size; ++k)
    turned[k] = valid[k] & (hits.front[k] == 0 ? -1 : 0);
  for (std::size_t k = 0; k < packet_size; ++k)
    leaves[k] = packet.leaving[k] != no_index ? -1 : 0;
  const auto missed_lanes = bits_of(missed);
  const auto leaving_lanes = bits_of(leaves);
  Doubts doubts;
  doubts.at_contact = missed_lanes & leaving_lanes;
  const auto met_lanes = bits_of(valid) & ~missed_lanes;
  if ((met_lanes & leaving_lanes) != 0) {
    for (std::size_t k = 0; k < packet_size; ++k) {
      const auto traced = static_cast<std::uint32_t>(valid[k] & ~missed[k]);
      const auto plane = geometry.facts[hits.triangle[k] & traced].plane;
      own[k] = touching[k] | (plane == packet.leaving[k] ? -1 : 0);
    }
    doubts.careful = bits_of(own) & met_lanes & leaving_lanes;
  }

  for (auto rest = bits_of(turned) & met_lanes & ~doubts.careful; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
    const auto bit = 1U << k;
    const auto& facts = geometry.facts[hits.triangle[k]];
    if (!facts.single_sided)
      continue;
    const auto left = (leaving_lanes & bit) != 0;
    if (backs == Backs::transparent)
      (left ? doubts.careful : doubts.through) |= bit;
    else if (facts.in_sheet)
      doubts.careful |= bit;
    else if (left)
      doubts.at_contact |= bit;
  }
  return doubts;
}

} // namespace meninas
