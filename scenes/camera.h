// Cameras as glTF has them: a frame in world space and a perspective or orthographic projection.
#pragma once

#include "scenes/types.h"

#include <string>

namespace meninas {

enum class Projection { perspective, orthographic };

struct Camera {
  std::string name;
  Projection projection = Projection::perspective;
  Point3 position{0.0};
  Direction right{1.0, 0.0, 0.0}; ///< right, up and forward are orthonormal; the camera looks along forward
  Direction up{0.0, 1.0, 0.0};
  Direction forward{0.0, 0.0, -1.0};
  double vertical_fov = 0.8;    ///< radians, perspective only
  double half_height = 1.0;     ///< metres, orthographic only
  double aspect = 0.0;          ///< width / height the file asks for, 0 when it leaves that to the picture
  double znear = 0.0;   ///< metres along forward within which the file wants nothing shown; 0: none
  double section = 0.0; ///< metres along forward at which rays start, in a plane; 0: the eye's
};

/// Origin, in the section plane, and direction of the ray through a point of the picture;
/// x and y run from 0 to 1, right and down.
struct CameraRay {
  Point3 origin;
  Direction direction;
};
CameraRay camera_ray(const Camera& camera, double picture_aspect, double x, double y);

struct Bounds {
  Point3 low{std::numeric_limits<double>::infinity()};
  Point3 high{-std::numeric_limits<double>::infinity()};
};

/// The view a scene without a camera gets:
/// from +X +Y +Z outside the bounds, all of them in the picture.
Camera default_camera(const Bounds& bounds);

} // namespace meninas
