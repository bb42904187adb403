// Reflection frusta:
// what the rays of a rectangle of the picture can come near to, straight or behind mirrors.
//
// Four corner rays bound the frustum, the planes between these, and the plane that it leaves.
// All lengths are in the frame of the ray scene.
// "Certainly" is by `frustum_margin`, many roundings away from all edges and planes.
#pragma once

#include "mirror/convex_polygon.h"
#include "scenes/rays/ray_scene.h"

#include <vector>

namespace meninas {

struct LightScene;

inline constexpr double frustum_margin = 1e-5; ///< floats are rounded by 6e-8

/// The points p with n . p >= offset are inside.
struct HalfSpace {
  Direction normal{0.0};
  double offset = 0.0;
};

struct Ball {
  Point3 centre{0.0};
  double radius = 0.0;
};

/// A patch as frusta meet it, a triangle or a parallelogram, in the frame of the ray scene.
struct FrustumFace {
  std::array<Point3, 4> corners{};
  std::array<HalfSpace, 4> edges{}; ///< what is inside of them, in the plane
  std::size_t corner_count = 3;
  Direction normal{0.0}; ///< towards its front
  double offset = 0.0;   ///< of its plane
  Ball around{};
  std::uint32_t triangle =
      0; ///< whose weights and (u, v) hold for all of it, below 0 and above 1 too
  std::uint32_t plane = 0;
  bool single_sided = false;
  bool can_be_sure = true; ///< no holes, no sliver
};

/// The faces that rays can meet. None where the scene has more triangles than `most`,
/// or glass, which attenuates rays one by one.
std::vector<FrustumFace> frustum_faces(const LightScene& light, std::size_t most);

/// The unfolded rays o + t d through the points (x, y) of a picture or a tile of it, in pixels;
/// o and d affine in (x, y), one of them constant, behind what they have left last.
struct PictureRays {
  Point3 origin;
  Vec3 origin_x, origin_y;
  Vec3 direction, direction_x, direction_y;
  HalfSpace near; ///< in which they are, and go on
};

PictureRays reflected(const PictureRays& rays, const HalfSpace& mirror);

/// The rays through the corners of the rectangle from (0,
/// 0) to `to`, and the planes around all of its rays.
struct Frustum {
  std::array<Point3, 4> origin;
  std::array<Vec3, 4> direction;
  std::array<HalfSpace, 5> bounds; ///< the last is where they come from
};
Frustum frustum_of(const PictureRays& rays, Vec2 to);

/// Whether all of it is outside one of the bounds.
bool is_outside(const Frustum& f, const Ball& ball);

/// The part in the frustum, and a margin more.
ConvexPolygon clip_to(const Frustum& f, ConvexPolygon polygon);

/// Weights of the second and third corner of a triangle at (x, y):
/// b1 and b2 over the last, each affine, times (1, x, y).
struct LandingForms {
  glm::dvec3 b1{0.0}, b2{0.0}, over{1.0, 0.0, 0.0};
};
LandingForms landing_forms(const std::array<Point3, 3>& corners, const PictureRays& rays);

} // namespace meninas
