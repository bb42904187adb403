// Rays and what they meet, one at a time and in packets of sixteen (ray_scene.h).
#pragma once

#include "scenes/types.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>

namespace meninas {

enum class Backs { absorb, transparent };

struct Ray {
  Point3 origin;
  Direction direction;
  PlaneId leaving = none<PlaneId>;
  double max_distance = std::numeric_limits<double>::infinity(); ///< metres
};

struct Hit {
  TriangleId triangle = none<TriangleId>;
  double distance = 0.0; ///< metres, along the ray
  Vec2 barycentric{0.0}; ///< weights of the triangle's second and third vertex
  bool front = true;     ///< false: the back of a surface, black if single-sided
};

/// The straight leg between two points, each on a plane of the scene or free (none).
/// Blocked by either side of what is between, but for glass.
struct Leg {
  Point3 from;
  Point3 to;
  PlaneId leaving = none<PlaneId>;
  PlaneId arriving = none<PlaneId>;
};

inline constexpr std::size_t packet_size = 16;

/// Sixteen rays, structure of arrays, in the frame of the ray scene.
/// Lanes from `count` on are not traced.
struct alignas(64) RayPacket {
  float origin_x[packet_size], origin_y[packet_size], origin_z[packet_size];
  float direction_x[packet_size], direction_y[packet_size], direction_z[packet_size];
  float max_distance[packet_size];     ///< frame units, in units of the direction's length
  std::uint32_t leaving[packet_size];  ///< index of a PlaneId, or of none
  std::uint32_t arriving[packet_size]; ///< occlusion only: the plane the leg ends on
  std::uint32_t count = 0;
};

/// Puts a ray into a lane, as far as it goes unless it is said how far.
/// Occlusion also needs `arriving`.
inline void set_ray(RayPacket& packet, std::uint32_t lane, const glm::vec3& origin,
                    const glm::vec3& direction, std::uint32_t leaving,
                    float max_distance = std::numeric_limits<float>::infinity()) {
  packet.origin_x[lane] = origin.x;
  packet.origin_y[lane] = origin.y;
  packet.origin_z[lane] = origin.z;
  packet.direction_x[lane] = direction.x;
  packet.direction_y[lane] = direction.y;
  packet.direction_z[lane] = direction.z;
  packet.max_distance[lane] = max_distance;
  packet.leaving[lane] = leaving;
}

struct alignas(64) HitPacket {
  std::uint32_t triangle[packet_size]; ///< index of a TriangleId, or of none for a miss
  float distance[packet_size];         ///< in units of the direction's length
  float b1[packet_size], b2[packet_size];
  std::uint8_t front[packet_size];
};

/// Rays of one origin or one pixel tile go together; scattered ones do not.
enum class Coherence { coherent, incoherent };

struct RayFrame {
  Point3 centre{0.0};
  double scale = 1.0; ///< frame units per metre
};

/// Whether a cut-out material leaves nothing at the point of a triangle with these weights
/// of its second and third vertex. Rays pass holes; safe from any number of threads.
using Holes = std::function<bool(TriangleId, Vec2)>;

/// The triangle that blocks a ray, by lane:
/// one of those that do; none where what blocks touches an end.
using Blockers = std::array<std::uint32_t, packet_size>;

/// Whether solids of glass are passed straight, each face like a pane, or let nothing through:
/// for those who find otherwise what they bend.
enum class Solids { sheets, opaque };

} // namespace meninas
