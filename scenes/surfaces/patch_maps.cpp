// The maps between (u, v) and points of a patch.
#include "scenes/surfaces/surfaces.h"

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

Vec2 clamped_to_triangle(Vec2 uv) {
  uv = glm::clamp(uv, Vec2(0.0), Vec2(1.0));
  const double beyond = uv.x + uv.y - 1.0;
  if (beyond > 0.0) {
    uv.x = std::clamp(uv.x - 0.5 * beyond, 0.0, 1.0);
    uv.y = 1.0 - uv.x;
  }
  return uv;
}

Vec2 triangle_uv_at(const Patch& patch, const Point3& x) {
  const Vec3 along_u = patch.corners[1] - patch.corners[0];
  const Vec3 along_v = patch.corners[2] - patch.corners[0];
  const Vec3 normal = glm::cross(along_u, along_v);
  const double squared = glm::dot(normal, normal);
  if (!(squared > 0.0)) {
    return Vec2(0.0);
  }
  const Vec3 h = x - patch.corners[0];
  return clamped_to_triangle(
      Vec2(glm::dot(glm::cross(h, along_v), normal), glm::dot(glm::cross(along_u, h), normal)) /
      squared);
}

/// The root of constant + linear t + quadratic t^2 in [0, 1] at which it rises, clamped.
///
/// Its slope there is the square root of the discriminant.
/// Of the two forms of the root each is free of cancellation where the other is not, and neither
/// divides by a vanishing quadratic term.
double rising_root(double constant, double linear, double quadratic) {
  if (!(constant < 0.0)) {
    return 0.0;
  }
  if (!(constant + linear + quadratic > 0.0)) {
    return 1.0;
  }
  const double slope = std::sqrt(std::max(0.0, linear * linear - 4.0 * constant * quadratic));
  const double root =
      linear >= 0.0 ? -2.0 * constant / (linear + slope) : (slope - linear) / (2.0 * quadratic);
  return std::clamp(root, 0.0, 1.0);
}

/// A quad p(s, t) = corner + s base + t side + s t widening, seen with `base` to `side`
/// counter-clockwise about the normal.
struct BilinearFrame {
  Vec3 base;
  Vec3 side;
  Vec3 widening;
  Direction normal;
};

/// (s, t) of the point at h from the corner: t first, by the line of constant t through the point,
/// then s along that line.
///
/// f(t) = cross(h - t side, base + t widening) is negative where the line passes below the point
/// and positive where it passes above, so in a convex quad it has one root in [0, 1], at which it
/// rises.
Vec2 solve_bilinear(const BilinearFrame& q, const Vec3& h) {
  const auto cross = [&](const Vec3& a, const Vec3& b) {
    return glm::dot(q.normal, glm::cross(a, b));
  };
  const double t = rising_root(cross(h, q.base), cross(h, q.widening) - cross(q.side, q.base),
                               -cross(q.side, q.widening));
  const Vec3 line = q.base + t * q.widening;
  const double squared = glm::dot(line, line);
  const double s = squared > 0.0 ? glm::dot(h - t * q.side, line) / squared : 0.0;
  return {std::clamp(s, 0.0, 1.0), t};
}

/// 1 for opposite sides of one length, 0 where one of them is a point.
double evenness(const Vec3& a, const Vec3& b) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  return std::min(la, lb) / std::max(la, lb);
}

Vec2 quad_uv_at(const Patch& patch, const Point3& x) {
  const auto& p = patch.corners;
  const Direction normal = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
  const Vec3 base = p[1] - p[0];
  const Vec3 side = p[3] - p[0];
  const Vec3 widening = (p[0] - p[1]) + (p[2] - p[3]);
  const Vec3 h = x - p[0];
  // Lines that shrink to a point near one end of the quad say little there, so the more even ones
  // are looked for.
  if (evenness(base, p[2] - p[3]) >= evenness(side, p[2] - p[1])) {
    return solve_bilinear({base, side, widening, normal}, h);
  }
  const Vec2 vu = solve_bilinear({side, base, widening, -normal}, h);
  return {vu.y, vu.x};
}

} // namespace

Point3 point_at(const Patch& patch, Vec2 uv) {
  const auto& p = patch.corners;
  const double u = uv.x;
  const double v = uv.y;
  if (patch.corner_count == 3) {
    return (1.0 - u - v) * p[0] + u * p[1] + v * p[2];
  }
  return (1.0 - v) * ((1.0 - u) * p[0] + u * p[1]) + v * ((1.0 - u) * p[3] + u * p[2]);
}

Vec2 patch_uv(const SurfaceModel& model, TriangleId triangle, Vec2 barycentric) {
  const auto& uv = model.corner_uv[index(triangle)];
  const double rest = 1.0 - barycentric.x - barycentric.y;
  const auto blend = [&](const auto& a, const auto& b, const auto& c) {
    return rest * a + barycentric.x * b + barycentric.y * c;
  };
  const Patch& patch = model.patches[index(model.patch_of_triangle[index(triangle)])];
  if (patch.affine) {
    const Vec2 inside = glm::clamp(blend(uv[0], uv[1], uv[2]), Vec2(0.0), Vec2(1.0));
    return patch.corner_count == 3 ? clamped_to_triangle(inside) : inside;
  }
  return uv_at(patch,
               blend(point_at(patch, uv[0]), point_at(patch, uv[1]), point_at(patch, uv[2])));
}

Vec2 uv_at(const Patch& patch, const Point3& x) {
  return patch.corner_count == 3 ? triangle_uv_at(patch, x) : quad_uv_at(patch, x);
}

} // namespace meninas
