#include "scenes/rays/curved_origin.h"

#include "scenes/rays/frame_geometry.h"
#include "scenes/shading_normal.h"

namespace meninas {

Point3 curved_origin(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                     TriangleId triangle, Vec2 barycentric, bool front) {
  const auto [a, b, c] = corners(scene, triangle);
  const Point3 flat = a + barycentric.x * (b - a) + barycentric.y * (c - a);
  Point3 origin = point_on_curve(scene, triangle, barycentric, front);
  const PlaneId plane = surfaces.plane_of_triangle[index(triangle)];
  if (origin != flat && occluded(rays, {flat, origin, plane, none<PlaneId>}))
    origin = flat;
  // Sixteen times the rounding of floats there: the triangle itself is not met from above it.
  constexpr double hair = 0x1p-20;
  const FrameGeometry& geometry = rays.geometry();
  const RayFrame& frame = geometry.frame;
  const float grain = grain_at(geometry, glm::vec3(to_frame(frame, origin)));
  const Direction face = surface_of(surfaces, triangle).plane.normal;
  return origin + (front ? hair : -hair) * double{grain} / frame.scale * face;
}

} // namespace meninas
