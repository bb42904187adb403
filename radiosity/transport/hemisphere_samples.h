// The rays that leave one receiver, in packets of sixteen.
//
// Directions are cosine-distributed and low-discrepancy: one Sobol net of N points, shifted
// digit by digit with a hash of the receiver (Kollig and Keller 2002), which keeps it a net.
// Points 0..15, 16..31, ... share a cell of directions, so packets are coherent.
#pragma once

#include "scenes/rays/ray_scene.h"
#include "scenes/sampling.h"

#include <span>
#include <vector>

namespace meninas {

struct RegionElement; // element_mesh.h
enum class ElementId : std::uint32_t;

/// Sixteen points of a net, lane by lane:
/// two coordinates of the place in the receiver, two of the direction.
struct alignas(64) NetPacket {
  std::array<std::array<std::uint32_t, packet_size>, 4> coordinates{};
};

/// N points of a four-dimensional net as integers, packets of sixteen ordered by direction.
struct HemisphereSamples {
  std::vector<std::array<std::uint32_t, 4>> points; ///< place in the element (two), direction (two)
  std::vector<NetPacket> packets;                   ///< the same; the last may not be full
  std::uint32_t first = 0; ///< the number of the first: so many others come before these
};
/// Without the first `before` points: they are the net of as many rays.
HemisphereSamples make_direction_net(int rays, int before = 0);

/// A parallelogram or triangle to spread the rays over, or the region of one that is left where it
/// is cut; a point when both edges are zero.
struct ReceiverArea {
  Point3 corner;
  Vec3 edge_u{0.0}, edge_v{0.0},
      edge_uv{0.0};      ///< x(s, t) = corner + s edge_u + t edge_v + s t edge_uv
  bool triangle = false; ///< then (s, t) is folded into s + t <= 1
  Direction normal;
  PlaneId plane_class = none<PlaneId>;
  Vec3 tangent{0.0}; ///< a direction in the plane that directions are counted from; zero: any
  MaterialId coat = none<MaterialId>; ///< above it, where that is a mirror
  bool reduced_rays = false; ///< little depends on its row (scene/small_elements.h)

  std::span<const ElementId> faces = {}; ///< of a cluster of elements, which must outlive it; of itself it has nothing else

  const RegionElement* region = nullptr; ///< of the area; must outlive it
  Point3 region_centre{0.0}; ///< its points are (x - centre) scale
  double region_scale = 1.0;

  bool is_point() const { return faces.empty() && edge_u == Vec3(0.0) && edge_v == Vec3(0.0); }
};

/// The frame of the normal that turns with the surface.
inline TangentFrame frame_along(const Direction& normal, const Vec3& tangent) {
  const Vec3 along = tangent - glm::dot(tangent, normal) * normal;
  const double length = glm::length(along);
  if (!(length > 0.0))
    return tangent_frame(normal);
  return {along / length, glm::cross(normal, along / length)};
}

/// The point of the area's region for (s, t): a map that keeps shares of area.
Point3 point_in_region(const ReceiverArea& area, Vec2 st);

/// The point of the area at (s, t), folded into the triangle where it is one.
inline Point3 point_in(const ReceiverArea& area, Vec2 st) {
  if (area.region != nullptr)
    return point_in_region(area, st);
  if (area.triangle && st.x + st.y > 1.0)
    st = 1.0 - st;
  return area.corner + st.x * area.edge_u + st.y * area.edge_v + st.x * st.y * area.edge_uv;
}

/// A receiver in the frame of the ray scene, with its own shift of the net.
struct RaySource {
  ReceiverArea area;
  TangentFrame tangents;
  std::array<std::uint32_t, 4> shift;
  std::vector<RaySource> faces = {};     ///< of a cluster
  std::vector<double> area_up_to = {}; ///< by face of a cluster, m^2: its own and of all before
};
RaySource ray_source(const ReceiverArea& receiver, const RayFrame& frame, std::uint32_t seed);

/// A value per lane.
using LaneFloats = std::array<float, packet_size>;

/// Where in the receiver, before triangles are folded, the rays of a packet of the net start:
/// s and t in [0, 1).
struct alignas(64) LanePlaces {
  LaneFloats s, t;
};
LanePlaces places_of(const NetPacket& net, const RaySource& source);

/// cosine_hemisphere(), sixteen at a time.
struct alignas(64) LaneDirections {
  LaneFloats x, y, z;
};
LaneDirections cosine_hemisphere(const LaneFloats& u, const LaneFloats& v);

/// Directions in the frame of the source's tangents and normal into those of the rays.
void set_directions(const LaneDirections& local, const RaySource& source, RayPacket& packet);

/// Puts the rays of a packet of the net into all lanes but `count`.
void set_rays(const NetPacket& net, const RaySource& source, RayPacket& packet);

} // namespace meninas
