// Paths of cameras against what circles and straight lines are.
#include "runs/batch/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas {
namespace {

constexpr double rounding = 1e-12;

CameraPath orbit(double from, double to, int frames) {
  CameraPath path;
  path.name = "turn";
  path.shape =
      Orbit{.centre = Point3(1.0, 2.0, 3.0), .radius = 5.0, .height = 2.0, .from = from, .to = to};
  path.frames = frames;
  return path;
}

TEST(CameraPath, AnOrbitKeepsItsDistanceAndLooksAtItsCentre) {
  const double turn = 2.0 * std::numbers::pi;
  const auto cameras = cameras_along(orbit(0.0, turn, 8), {});
  ASSERT_EQ(cameras.size(), 8);
  for (std::size_t k = 0; k < 8; ++k) {
    const Camera& camera = cameras[k];
    const Vec3 out = camera.position - Point3(1.0, 2.0, 3.0);
    const double angle = double(k) * turn / 8.0;
    EXPECT_NEAR(std::hypot(out.x, out.z), 5.0, rounding);
    EXPECT_NEAR(out.y, 2.0, rounding);
    EXPECT_NEAR(std::atan2(out.x, out.z), angle <= turn / 2.0 ? angle : angle - turn, rounding);
    EXPECT_NEAR(glm::length(camera.forward + glm::normalize(out)), 0.0, rounding);
    EXPECT_NEAR(camera.right.y, 0.0, rounding);
    EXPECT_GT(camera.up.y, 0.0);
    EXPECT_NEAR(glm::length(glm::cross(camera.right, camera.up) + camera.forward), 0.0, rounding);
    EXPECT_EQ(camera.name, "turn");
  }
}

TEST(CameraPath, AnArcHasBothItsEnds) {
  const auto cameras = cameras_along(orbit(0.0, std::numbers::pi / 2.0, 3), {});
  EXPECT_NEAR(glm::distance(cameras.front().position, Point3(1.0, 4.0, 8.0)), 0.0, rounding);
  EXPECT_NEAR(glm::distance(cameras.back().position, Point3(6.0, 4.0, 3.0)), 0.0, rounding);
}

TEST(CameraPath, WithoutACentreItIsThatOfTheScene) {
  CameraPath path = orbit(0.0, 1.0, 1);
  std::get<Orbit>(path.shape).centre.reset();
  const auto cameras = cameras_along(path, {Point3(0.0), Point3(2.0, 4.0, 6.0)});
  EXPECT_NEAR(glm::distance(cameras[0].position, Point3(1.0, 4.0, 8.0)), 0.0, rounding);
}

std::vector<Pose> bent_walk() {
  return {{{0, 1, 0}, {0, 1, -1}, 0.6, 0.0},
          {{1, 1, -2}, {2, 1, -2}, std::nullopt, 1.0},
          {{4, 2, -2}, {4, 2, 5}, 1.2, 3.0}};
}

TEST(CameraPath, AWalkGoesThroughItsPoses) {
  CameraPath path;
  path.shape = bent_walk();
  path.vertical_fov = 0.9;
  const auto cameras = cameras_along(path, {});
  ASSERT_EQ(cameras.size(), 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const Pose pose = bent_walk()[k];
    EXPECT_NEAR(glm::distance(cameras[k].position, pose.position), 0.0, rounding);
    const Direction sight = glm::normalize(pose.target - pose.position);
    EXPECT_NEAR(glm::distance(cameras[k].forward, sight), 0.0, rounding);
    EXPECT_NEAR(cameras[k].vertical_fov, pose.vertical_fov.value_or(0.9), rounding);
  }
  // Seven frames are half a unit of time apart: poses are frames 0, 2 and 6.
  path.frames = 7;
  const auto timed = cameras_along(path, {});
  ASSERT_EQ(timed.size(), 7);
  EXPECT_NEAR(glm::distance(timed[2].position, cameras[1].position), 0.0, rounding);
  EXPECT_NEAR(glm::distance(timed[6].position, cameras[2].position), 0.0, rounding);
  EXPECT_NEAR(timed[1].vertical_fov, 0.75, rounding);
}

// A cubic that has the values and slopes of a straight line is that line, whatever the times are.
TEST(CameraPath, UniformMotionStaysUniform) {
  CameraPath path;
  std::vector<Pose> poses;
  for (const double t : {0.0, 1.0, 1.5, 4.0}) {
    poses.push_back({Point3(t, 2.0 * t, 0.0), Point3(t, 2.0 * t, -1.0), std::nullopt, t});
  }
  path.shape = poses;
  path.frames = 9;
  const auto cameras = cameras_along(path, {});
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const double t = 0.5 * double(k);
    EXPECT_NEAR(glm::distance(cameras[k].position, Point3(t, 2.0 * t, 0.0)), 0.0, rounding);
  }
}

TEST(CameraPath, VelocityDoesNotJumpAtAPose) {
  CameraPath path;
  path.shape = bent_walk();
  path.frames = 3001;
  const auto cameras = cameras_along(path, {});
  const Vec3 before = cameras[1000].position - cameras[999].position,
             after = cameras[1001].position - cameras[1000].position;
  // Over a thousandth of a unit of time the velocity,
  // about two, changes by the acceleration, less than ten.
  EXPECT_LT(glm::length(after - before), 1e-3 * 1e-3 * 10.0);
  EXPECT_GT(glm::length(after), 1e-3);
}

TEST(CameraPath, StraightUpAndDownHaveATop) {
  const Camera down = looking_at({0, 5, 0}, {0, 0, 0}, 0.8),
               up = looking_at({0, 0, 0}, {0, 5, 0}, 0.8);
  EXPECT_EQ(down.up, Direction(0.0, 0.0, -1.0));
  EXPECT_EQ(up.up, Direction(0.0, 0.0, 1.0));
  EXPECT_EQ(down.right, up.right);
}

} // namespace
} // namespace meninas
