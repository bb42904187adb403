#include "scenes/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

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

double half_height_of(const Camera& camera, double picture_aspect) {
  const double of_file = camera.projection == Projection::orthographic
                             ? camera.half_height
                             : std::tan(0.5 * camera.vertical_fov);
  if (camera.sensor_fit == SensorFit::vertical || !(camera.aspect > 0.0))
    return of_file;
  const double half_width = of_file * camera.aspect;
  if (camera.sensor_fit == SensorFit::horizontal)
    return half_width / picture_aspect;
  return std::max(half_width, of_file) / std::max(picture_aspect, 1.0);
}

double natural_aspect(const Camera& camera) {
  switch (camera.projection) {
  case Projection::equirectangular:
    return 2.0;
  case Projection::cube:
    return cube_faces;
  case Projection::perspective:
  case Projection::orthographic:
    break;
  }
  return camera.aspect;
}

CubeFace cube_face(const Camera& camera, int face) {
  const auto& [r, u, f] = std::tie(camera.right, camera.up, camera.forward);
  switch (face) {
  case 0:
    return {-f, u, r};
  case 1:
    return {f, u, -r};
  case 2:
    return {r, -f, u};
  case 3:
    return {r, f, -u};
  case 4:
    return {r, u, f};
  default:
    return {-r, u, -f};
  }
}

static Direction around(const Camera& camera, double x, double y) {
  const double longitude = std::numbers::pi * (2.0 * x - 1.0);
  const double latitude = std::numbers::pi * (0.5 - y);
  return std::cos(latitude) *
             (std::sin(longitude) * camera.right + std::cos(longitude) * camera.forward) +
         std::sin(latitude) * camera.up;
}

static Direction through_cube(const Camera& camera, double x, double y) {
  const double place = cube_faces * x;
  const int number = std::clamp(static_cast<int>(std::floor(place)), 0, cube_faces - 1);
  const CubeFace face = cube_face(camera, number);
  return glm::normalize(face.forward + (2.0 * (place - number) - 1.0) * face.right +
                        (1.0 - 2.0 * y) * face.up);
}

CameraRay camera_ray(const Camera& camera, double picture_aspect, double x, double y, Vec2 lens) {
  if (camera.projection == Projection::equirectangular)
    return {camera.position, around(camera, x, y)};
  if (camera.projection == Projection::cube)
    return {camera.position, through_cube(camera, x, y)};
  // By the angle across the height, whatever the picture's aspect is, unless the sensor says else.
  const double half = half_height_of(camera, picture_aspect);
  const double across = (2.0 * x - 1.0) * picture_aspect;
  const double upwards = 1.0 - 2.0 * y;
  if (camera.projection == Projection::orthographic) {
    const Vec3 offset = half * (across * camera.right + upwards * camera.up);
    return {camera.position + offset + camera.section * camera.forward, camera.forward};
  }
  const Vec3 towards = camera.forward + half * (across * camera.right + upwards * camera.up);
  if (camera.lens_radius == 0.0)
    return {camera.position + camera.section * towards, glm::normalize(towards)};
  const Vec3 offset = camera.lens_radius * (lens.x * camera.right + lens.y * camera.up);
  const Vec3 to_focus = towards - offset / camera.focus_distance;
  return {camera.position + offset + camera.section * to_focus, glm::normalize(to_focus)};
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
