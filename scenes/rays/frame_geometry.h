// The triangles of a scene in the frame of its ray queries:
// recentred and rescaled so that the bounds fit into [-1, 1].
//
// Where some of it lies far beyond the detail, the detail is in the middle of the frame:
// there floats are finer, and all that is said of rounding is meant times the grain of the place.
#pragma once

#include "scenes/rays/rays.h"
#include "scenes/scene.h"
#include "scenes/surfaces/surfaces.h"

#include <algorithm>
#include <cmath>

namespace meninas {

struct TriangleFacts {
  std::uint32_t plane = index(none<PlaneId>);
  bool single_sided = false;
  bool in_sheet =
      false;            ///< its plane class has a face the other way: it may be one side of a sheet
  bool cut_out = false; ///< it may have holes
  bool hidden = false;  ///< rays meet another one in its place (hidden_copies.h)
  bool glass = false;   ///< it does not occlude
  bool solid = false;   ///< it is the surface of solid glass
};

struct FrameNormal {
  float x = 0.0F, y = 0.0F, z = 0.0F, unused = 0.0F;
};

struct FrameGeometry {
  RayFrame frame;
  std::vector<Point3> positions; ///< of the vertices, in the frame
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<TriangleFacts> facts;     ///< per triangle
  std::vector<Direction> plane_normals; ///< per plane class
  std::vector<FrameNormal>
      lifts;           ///< the same in floats, and one of length zero for rays that leave no plane
  double noise = 0.0;  ///< heights below it are rounding, in frame units of grain 1
  float detail = 1.0F; ///< the grain nearest to the middle
  Holes holes;
  std::vector<Plane> glass; ///< the planes that hold some, in metres
};

FrameGeometry make_frame_geometry(const Scene& scene, const SurfaceModel& surfaces,
                                  Holes holes = {});

/// The rounding at a point of the frame, relative to that at its bounds.
inline float grain_at(const FrameGeometry& geometry, float x, float y, float z) {
  return std::min(1.0F, std::max({geometry.detail, std::abs(x), std::abs(y), std::abs(z)}));
}
inline float grain_at(const FrameGeometry& geometry, const glm::vec3& x) {
  return grain_at(geometry, x.x, x.y, x.z);
}

/// Whether nothing is there at the point of a triangle
/// with these weights of its second and third vertex.
inline bool is_hole(const FrameGeometry& geometry, std::uint32_t triangle, Vec2 barycentric) {
  return geometry.facts[triangle].cut_out && geometry.holes(TriangleId{triangle}, barycentric);
}

/// The triangle itself, or where it is hidden one without area, which is never met.
inline std::array<std::uint32_t, 3> met_by_rays(const std::array<std::uint32_t, 3>& triangle,
                                                const TriangleFacts& facts) {
  return facts.hidden ? std::array<std::uint32_t, 3>{} : triangle;
}

std::array<Point3, 3> corners_of(const FrameGeometry& geometry, std::uint32_t triangle);

inline Point3 to_frame(const RayFrame& frame, const Point3& x) {
  return (x - frame.centre) * frame.scale;
}

} // namespace meninas
