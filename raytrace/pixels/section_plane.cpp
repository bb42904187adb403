#include "raytrace/pixels/section_plane.h"

#include "mirror/convex_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {

namespace {

/// The points x with dot(normal, x - origin) >= 0 are inside.
struct Bound {
  Point3 origin;
  Vec3 normal;
};

} // namespace

/// The bounds of the space that a picture shows before the plane at that depth.
static std::array<Bound, 6> bounds_before(const Camera& camera, double picture_aspect,
                                          double depth) {
  const bool perspective = camera.projection == Projection::perspective;
  const double half_height = half_height_of(camera, picture_aspect);
  // Rays from the edge of a lens are so much off those from its centre, at the most.
  const double beside =
      camera.lens_radius * std::max(1.0, std::abs(1.0 - depth / camera.focus_distance));
  const Vec3 across = half_height * picture_aspect * camera.right, upwards = half_height * camera.up;
  const Point3& eye = camera.position;
  const auto side = [&](const Vec3& axis, const Vec3& half) {
    // In perspective the plane through the eye and the edge of the picture at distance one.
    return perspective ? Bound{eye + beside * axis, glm::length(half) * camera.forward - axis}
                       : Bound{eye + half, -axis};
  };
  return {side(camera.right, across), side(-camera.right, -across), side(camera.up, upwards),
          side(-camera.up, -upwards), Bound{eye, camera.forward},
          Bound{eye + depth * camera.forward, -camera.forward}};
}

static bool is_seen(const Scene& scene, const Camera& camera, TriangleId triangle) {
  const Material& material = material_of(scene, triangle);
  if (material.double_sided || is_glass(material))
    return true;
  const auto p = corners(scene, triangle);
  const Vec3 towards = camera.projection == Projection::perspective ? camera.position - p[0]
                                                                    : -camera.forward;
  return glm::dot(area_vector(p), towards) > 0.0;
}

static bool reaches_in(std::span<const Bound> bounds, const std::array<Point3, 3>& triangle) {
  ConvexPolygon part{std::span<const Point3>(triangle)};
  for (const Bound& bound : bounds) {
    const auto is_out = [&](const Point3& x) { return !(glm::dot(bound.normal, x - bound.origin) > 0.0); };
    if (std::ranges::all_of(part.span(), is_out))
      return false;
    clip_in_place(part, bound.origin, bound.normal);
  }
  return !part.empty();
}

/// The depth of the scene along the view.
static double depth_of(const Bounds& bounds, const Camera& camera) {
  const Vec3 low = bounds.low - camera.position, high = bounds.high - camera.position;
  const Vec3 &f = camera.forward, farthest = glm::max(f * low, f * high);
  return farthest.x + farthest.y + farthest.z;
}

Camera with_section(const Scene& scene, Camera camera, double picture_aspect) {
  constexpr double a_hair = 2e-5; // of the radius: frusta are certain to half of it
  if (!(camera.znear > 0.0) || is_panorama(camera.projection))
    return camera;
  const Bounds all = bounds_of(scene);
  const Vec3 size = all.high - all.low;
  const double hair = a_hair * 0.5 * std::max({size.x, size.y, size.z});
  const auto bounds = bounds_before(camera, picture_aspect, camera.znear - hair);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (reaches_in(bounds, corners(scene, TriangleId{t})) &&
        is_seen(scene, camera, TriangleId{t})) {
      camera.section = std::min(camera.znear, depth_of(all, camera)) + hair;
      return camera;
    }
  }
  return camera;
}

} // namespace meninas
