#include "scenes/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {
namespace {

/// Corners of the bounds relative to their centre.
std::array<Vec3, 8> corner_offsets(const Vec3& half_size) {
  std::array<Vec3, 8> offsets;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    offsets[i] = {(i & 1) != 0 ? half_size.x : -half_size.x,
                  (i & 2) != 0 ? half_size.y : -half_size.y,
                  (i & 4) != 0 ? half_size.z : -half_size.z};
  }
  return offsets;
}

double largest_component(const Vec3& x) {
  return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
}

} // namespace

CameraRay camera_ray(const Camera& camera, double picture_aspect, double x, double y) {
  const double across = (2.0 * x - 1.0) * picture_aspect;
  const double upwards = 1.0 - 2.0 * y;
  if (camera.projection == Projection::orthographic) {
    const Vec3 offset = camera.half_height * (across * camera.right + upwards * camera.up);
    return {camera.position + offset + camera.section * camera.forward, camera.forward};
  }
  // The vertical angle spans the height of the picture whatever its aspect is.
  const double half = std::tan(0.5 * camera.vertical_fov);
  const Vec3 towards = camera.forward + half * (across * camera.right + upwards * camera.up);
  return {camera.position + camera.section * towards, glm::normalize(towards)};
}

Camera default_camera(const Bounds& bounds) {
  constexpr double margin = 1.1;
  Camera camera;
  camera.name = "default";
  camera.forward = glm::normalize(Vec3(-1.0));
  camera.right = glm::normalize(glm::cross(camera.forward, Vec3(0.0, 1.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);

  const bool empty = !(bounds.low.x <= bounds.high.x && bounds.low.y <= bounds.high.y &&
                       bounds.low.z <= bounds.high.z);
  const Point3 centre = empty ? Point3(0.0) : 0.5 * bounds.low + 0.5 * bounds.high;
  const Vec3 half_size = empty ? Vec3(1.0) : 0.5 * bounds.high - 0.5 * bounds.low;

  // A corner at height h and depth z before the centre is in a picture of half angle a when |h| <=
  // (d + z) tan a.
  const double slope = std::tan(0.5 * camera.vertical_fov) / margin;
  // Farther than the bounding sphere the eye is outside; a single point is looked at from a metre
  // away.
  double distance = margin * glm::length(half_size);
  for (const Vec3& corner : corner_offsets(half_size)) {
    const double off_axis =
        std::max(std::abs(glm::dot(corner, camera.right)), std::abs(glm::dot(corner, camera.up)));
    distance = std::max(distance, off_axis / slope - glm::dot(corner, camera.forward));
  }
  if (distance == 0.0) {
    distance = 1.0;
  }
  // The eye has to differ from the centre by many steps of the precision of doubles.
  distance = std::max(distance, 1e-9 * largest_component(centre));
  camera.position = centre - distance * camera.forward;
  return camera;
}

} // namespace meninas
