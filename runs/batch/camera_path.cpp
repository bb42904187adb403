#include "runs/batch/camera_path.h"

#include "scenes/types.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace meninas {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

std::vector<Camera> along_orbit(const Orbit& orbit, const CameraPath& path, const Bounds& scene) {
  const Point3 centre = orbit.centre ? *orbit.centre : 0.5 * scene.low + 0.5 * scene.high;
  const double turn = orbit.to - orbit.from;
  const bool closed = std::abs(std::abs(turn) - full_turn) < 1e-9;
  const int frames = path.frames.value_or(1), steps = closed ? frames : std::max(frames - 1, 1);
  std::vector<Camera> cameras;
  for (int frame = 0; frame < frames; ++frame) {
    const double angle = orbit.from + turn * frame / steps;
    const Vec3 out{orbit.radius * std::sin(angle), orbit.height, orbit.radius * std::cos(angle)};
    cameras.push_back(looking_at(centre + out, centre, path.vertical_fov));
  }
  return cameras;
}

/// The derivative by time at pose k.
Vec3 tangent(const std::vector<Pose>& poses, std::size_t k, Point3 Pose::*point) {
  const Pose& before = poses[k == 0 ? 0 : k - 1];
  const Pose& after = poses[std::min(k + 1, poses.size() - 1)];
  return (after.*point - before.*point) / (after.at - before.at);
}

/// The cubic between poses k and k + 1 that has their values and tangents; s in [0, 1].
Point3 hermite(const std::vector<Pose>& poses, std::size_t k, double s, Point3 Pose::*point) {
  const double step = poses[k + 1].at - poses[k].at, s2 = s * s, s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * poses[k].*point +
         (s3 - 2.0 * s2 + s) * step * tangent(poses, k, point) +
         (3.0 * s2 - 2.0 * s3) * poses[k + 1].*point +
         (s3 - s2) * step * tangent(poses, k + 1, point);
}

Camera walker_at(const std::vector<Pose>& poses, double time, double otherwise) {
  const auto fov = [&](const Pose& pose) { return pose.vertical_fov.value_or(otherwise); };
  if (poses.size() == 1) {
    return looking_at(poses[0].position, poses[0].target, fov(poses[0]));
  }
  std::size_t k = 0;
  while (k + 2 < poses.size() && poses[k + 1].at <= time) {
    ++k;
  }
  const double s = std::clamp((time - poses[k].at) / (poses[k + 1].at - poses[k].at), 0.0, 1.0);
  return looking_at(hermite(poses, k, s, &Pose::position), hermite(poses, k, s, &Pose::target),
                    (1.0 - s) * fov(poses[k]) + s * fov(poses[k + 1]));
}

std::vector<Camera> along_walk(const std::vector<Pose>& poses, const CameraPath& path) {
  std::vector<double> times;
  if (!path.frames) {
    std::ranges::transform(poses, std::back_inserter(times), &Pose::at);
  }
  const double begin = poses.front().at, length = poses.back().at - begin;
  for (int frame = 0; frame < path.frames.value_or(0); ++frame) {
    times.push_back(begin + length * frame / std::max(*path.frames - 1, 1));
  }
  std::vector<Camera> cameras;
  for (const double time : times) {
    cameras.push_back(walker_at(poses, time, path.vertical_fov));
  }
  return cameras;
}

} // namespace

Camera looking_at(const Point3& position, const Point3& target, double vertical_fov) {
  Camera camera;
  camera.position = position;
  camera.vertical_fov = vertical_fov;
  const Vec3 sight = target - position;
  const double distance = glm::length(sight);
  camera.forward = distance > 0.0 ? sight / distance : Direction(0.0, 0.0, -1.0);
  // Looking straight up or down there is no upright:
  // the picture's top is where it comes to lie by tilting from a view along -z.
  Vec3 right = glm::cross(camera.forward, Vec3(0.0, 1.0, 0.0));
  constexpr double upright = 1e-9;
  if (glm::length(right) < upright) {
    right = Vec3(1.0, 0.0, 0.0);
  }
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);
  return camera;
}

std::vector<Camera> cameras_along(const CameraPath& path, const Bounds& scene) {
  expects(path.frames.value_or(1) > 0, "a path has frames");
  std::vector<Camera> cameras;
  if (const auto* orbit = std::get_if<Orbit>(&path.shape)) {
    cameras = along_orbit(*orbit, path, scene);
  } else {
    cameras = along_walk(std::get<std::vector<Pose>>(path.shape), path);
  }
  for (Camera& camera : cameras) {
    camera.name = path.name;
  }
  return cameras;
}

} // namespace meninas
