// Cameras that move: a path by keyframes, and the camera of every frame of it.
//
// A walk goes through its poses at their times: position and target are cubic Hermite curves with
// the tangents of Catmull and Rom 1974 for uneven times, m_k = (p_k+1 - p_k-1) / (t_k+1 - t_k-1),
// one-sided at the ends; the angle of view changes linearly.
// An orbit is a circle in a horizontal plane:
// centre + height up + radius (sin a, 0, cos a), looking at the centre.
#pragma once

#include "scenes/camera.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace meninas {

struct Pose {
  Point3 position{0.0}, target{0.0};
  std::optional<double> vertical_fov; ///< radians
  double at = 0.0;                    ///< rises from pose to pose
};

struct Orbit {
  std::optional<Point3> centre; ///< that of the scene's bounds otherwise
  double radius = 1.0;
  double height = 0.0;
  double from = 0.0,
         to = 0.0; ///< radians from +z towards +x; a full turn does not repeat its first frame
};

struct CameraPath {
  std::string name;
  std::variant<Orbit, std::vector<Pose>> shape;
  std::optional<int> frames; ///< at equal steps of time; otherwise one at each pose
  double vertical_fov = Camera{}.vertical_fov; ///< radians, where a pose has no other
};

/// One camera per frame, all of the path's name.
std::vector<Camera> cameras_along(const CameraPath& path, const Bounds& scene);

/// At the position, upright, looking at the target;
/// straight up or down, -z (looking down) or +z is up.
Camera looking_at(const Point3& position, const Point3& target, double vertical_fov);

} // namespace meninas
