#include "raytrace/camera_rays.h"

#include <cmath>

namespace meninas {

CameraFrame make_camera_frame(const Camera& camera, double picture_aspect, const RayFrame& frame) {
  const Point3 eye = (camera.position - frame.centre) * frame.scale;
  CameraFrame rays{};
  if (camera.projection == Projection::perspective) {
    // The picture plane at distance one: from its upper left corner, right by x and down by y.
    const double half_height = std::tan(0.5 * camera.vertical_fov), half_width = half_height * picture_aspect;
    rays.origin = eye;
    rays.direction = camera.forward - half_width * camera.right + half_height * camera.up;
    rays.direction_x = 2.0 * half_width * camera.right;
    rays.direction_y = -2.0 * half_height * camera.up;
    return rays;
  }
  const double half_height = camera.half_height * frame.scale, half_width = half_height * picture_aspect;
  rays.origin = eye - half_width * camera.right + half_height * camera.up;
  rays.origin_x = 2.0 * half_width * camera.right;
  rays.origin_y = -2.0 * half_height * camera.up;
  rays.direction = camera.forward;
  return rays;
}

} // namespace meninas
