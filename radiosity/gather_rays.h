// The hemisphere of one receiver, followed by rays: where they land, in which mirror world, with what throughput.
//
// Directions are cosine-distributed and low-discrepancy: one Sobol net of N points, shifted digit by digit with a hash of the receiver
// (Kollig and Keller 2002), which keeps it a net. Points 0..15, 16..31, ... share a cell of directions, so packets are coherent.
#pragma once

#include "radiosity/form_factors.h"
#include "scenes/sampling.h"

#include <span>

namespace meninas {

/// N points of a four-dimensional net as integers, packets of sixteen ordered by direction.
struct DirectionNet {
  std::vector<std::array<std::uint32_t, 4>> points; ///< place in the element (two), direction (two)
};
DirectionNet make_direction_net(int rays);

struct RayLanding {
  std::uint32_t element;
  WorldId world;        ///< none beyond the enumerated worlds
  glm::vec3 throughput; ///< product of the mirrors' reflectances
};

/// The covered part of a receiver, by cells of 8 x 8 over its (s, t): bit 8 i + j is cell (i, j). Where all rays of a cell meet black
/// backs at once, those along the surface too, something stands on that part of it: no light can reach it, and nothing sees it.
using CoveredCells = std::uint64_t;
inline std::uint32_t cell_of(double s, double t) {
  return 8U * static_cast<std::uint32_t>(8.0 * s) + static_cast<std::uint32_t>(8.0 * t);
}
inline bool is_covered(CoveredCells covered, double s, double t) { return ((covered >> cell_of(s, t)) & 1U) != 0; }

/// All N rays of one receiver; storage reused from one to the next.
struct GatheredRays {
  std::vector<RayLanding> landings;
  std::uint32_t escaped = 0, black = 0, cut = 0; ///< rays that ended otherwise
  glm::vec3 mirror_absorbed{0.0F};               ///< sum of 1 - tau over all rays
  glm::vec3 escaped_light{0.0F}, black_light{0.0F}, cut_light{0.0F}; ///< sums of tau over the rays that ended so
  std::uint64_t traced = 0;
  CoveredCells covered = 0;
  std::uint32_t covered_rays = 0; ///< of `black`, those from covered cells
};

/// How many rays' light was followed to its end: what is cut is left out, what a mirror has absorbed on the way is not.
inline Rgb kept_light(const GatheredRays& gathered, std::size_t rays) {
  return glm::max(Rgb(1.0), static_cast<double>(rays) - gathered.covered_rays - Rgb(gathered.cut_light));
}

/// A parallelogram or triangle to spread the rays over; a point when both edges are zero.
struct ReceiverArea {
  Point3 corner;
  Vec3 edge_u{0.0}, edge_v{0.0}, edge_uv{0.0}; ///< x(s, t) = corner + s edge_u + t edge_v + s t edge_uv
  bool triangle = false;                       ///< then (s, t) is folded into s + t <= 1
  Direction normal;
  PlaneId plane_class = none<PlaneId>;
  Vec3 tangent{0.0}; ///< a direction in the plane that directions are counted from; zero: any

  bool is_point() const { return edge_u == Vec3(0.0) && edge_v == Vec3(0.0); }
};

/// The frame of the normal that turns with the surface.
inline TangentFrame frame_along(const Direction& normal, const Vec3& tangent) {
  const Vec3 along = tangent - glm::dot(tangent, normal) * normal;
  const double length = glm::length(along);
  if (!(length > 0.0)) return tangent_frame(normal);
  return {along / length, glm::cross(normal, along / length)};
}

/// A continuing ray between mirrors; kept by the caller so that its storage is reused.
struct MirroredRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  glm::vec3 throughput;
  WorldId world;
  std::uint32_t leaving;
};

struct GatherWorkspace {
  GatheredRays result;
  std::uint32_t black_lanes = 0; ///< of the last packet
  std::vector<MirroredRay> current, next;
};

/// Traces the net from the receiver; the result stands in workspace.result.
void gather_rays(const LightScene& light, const DirectionNet& net, const ReceiverArea& receiver, std::uint32_t seed,
                 const FormFactorSettings& settings, GatherWorkspace& workspace);

ReceiverArea receiver_of(const LightScene& light, ElementId element);

/// The point of the area at (s, t), folded into the triangle where it is one.
inline Point3 point_in(const ReceiverArea& area, Vec2 st) {
  if (area.triangle && st.x + st.y > 1.0) st = 1.0 - st;
  return area.corner + st.x * area.edge_u + st.y * area.edge_v + st.x * st.y * area.edge_uv;
}

/// The emission (times throughput) a landed ray brings where no closed form owns it: emitters gathered as a whole,
/// and the others beyond the enumerated worlds.
inline Rgb gathered_emission(const LightScene& light, const RayLanding& landing) {
  const SideId side = light.mesh.side_of_element[landing.element];
  const bool owned = light.from_source[index(side)] != 0 && landing.world != none<WorldId>;
  return owned ? Rgb(0.0) : light.mesh.sides[index(side)].emission * Rgb(landing.throughput);
}

} // namespace meninas
