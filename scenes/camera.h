// Cameras as glTF has them: a frame in world space and a perspective or orthographic projection,
// with a lens where the file's extras say so; and panoramas from where such a camera stands.
//
// A point (x, y) of the picture, from 0 to 1 right and down, with a = 2x - 1 and b = 1 - 2y, is seen
//   perspective      along forward + h (a p right + b up), p the picture's width / height, h the
//                    tangent of half the vertical angle
//   equirectangular  along cos(pi b / 2) (sin(pi a) right + cos(pi a) forward) + sin(pi b / 2) up:
//                    the whole sphere, forward in the middle
//   cube             the faces right, left, up, down, forward, back in a row, each a perspective
//                    of 90 degrees by 90; the lower edge of up and the upper one of down meet forward
//
// With a lens (thin, Cook, Porter and Carpenter 1984) the ray starts at a point l of its disc and
// goes to where that from its centre meets the plane of focus, at the distance d along forward. A point
// at z spreads over a circle of the diameter 2 R abs(z - d) / z in that plane.
#pragma once

#include "scenes/types.h"

#include <string>

namespace meninas {

enum class Projection { perspective, orthographic, equirectangular, cube };

/// From everywhere about the camera's place.
inline bool is_panorama(Projection projection) {
  return projection == Projection::equirectangular || projection == Projection::cube;
}

/// Which side of the frame the file asks for a picture of another aspect keeps whole.
enum class SensorFit { vertical, horizontal, longer };

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
  SensorFit sensor_fit = SensorFit::vertical; ///< matters where the file asks for an aspect
  double lens_radius = 0.0; ///< metres, R above, perspective only; 0: a pinhole
  double focus_distance = 1.0; ///< metres along forward, d above; matters where there is a lens
  double znear = 0.0;   ///< metres along forward within which the file wants nothing shown; 0: none
  double section = 0.0; ///< metres along forward at which rays start, in a plane; 0: the eye's
};

/// Half of the picture's height in the plane at distance one (perspective: h above), or in metres
/// (orthographic).
double half_height_of(const Camera& camera, double picture_aspect);

/// The width / height at which pixels in the middle of a picture are squares; 0: at any.
double natural_aspect(const Camera& camera);

/// Origin, in the section plane, and unit direction of the ray through a point of the picture;
/// `lens`, in the unit disc, is where it starts on the lens.
struct CameraRay {
  Point3 origin;
  Direction direction;
};
CameraRay camera_ray(const Camera& camera, double picture_aspect, double x, double y,
                     Vec2 lens = Vec2(0.0));

inline constexpr int cube_faces = 6;

/// The frame of a face of the cube, 0 to 5 in the order above.
struct CubeFace {
  Direction right, up, forward;
};
CubeFace cube_face(const Camera& camera, int face);

struct Bounds {
  Point3 low{std::numeric_limits<double>::infinity()};
  Point3 high{-std::numeric_limits<double>::infinity()};
};

/// The view a scene without a camera gets:
/// from +X +Y +Z outside the bounds, all of them in the picture.
Camera default_camera(const Bounds& bounds);

} // namespace meninas
