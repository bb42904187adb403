#include "scenes/camera.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// Directions are normalised, which costs a few roundings.
constexpr double rounding = 1e-15;

TEST(Camera, PerspectiveSpansTheVerticalAngle) {
  const Camera camera = look_at({1.0, 2.0, 3.0}, Point3(1.0, 2.0, 0.0), 0.9);
  const auto angle = [&](double aspect, double x, double y) {
    const CameraRay ray = camera_ray(camera, aspect, x, y);
    EXPECT_EQ(ray.origin, camera.position);
    EXPECT_NEAR(glm::length(ray.direction), 1.0, rounding);
    return std::array{
        std::atan2(glm::dot(ray.direction, camera.right), glm::dot(ray.direction, camera.forward)),
        std::atan2(glm::dot(ray.direction, camera.up), glm::dot(ray.direction, camera.forward))};
  };
  EXPECT_NEAR(angle(1.6, 0.5, 0.0)[1], 0.45, rounding);
  EXPECT_NEAR(angle(1.6, 0.5, 1.0)[1], -0.45, rounding);
  EXPECT_NEAR(angle(1.0, 1.0, 0.5)[0], 0.45, rounding);
  EXPECT_NEAR(angle(1.0, 0.0, 0.5)[0], -0.45, rounding);
  // Whatever the aspect of the picture, its height keeps the angle and its width follows.
  EXPECT_NEAR(angle(1.6, 1.0, 0.5)[0], std::atan(1.6 * std::tan(0.45)), rounding);
  EXPECT_NEAR(angle(0.5, 0.5, 0.0)[1], 0.45, rounding);
}

TEST(Camera, TheAspectInTheFileKeepsTheVerticalAngle) {
  Camera camera = look_at({0.0, 0.0, 1.0}, Point3(0.0), 0.9);
  const CameraRay ray = camera_ray(camera, 1.0, 0.25, 0.1);
  camera.aspect = 2.0;
  EXPECT_EQ(camera_ray(camera, 1.0, 0.25, 0.1).direction, ray.direction);
}

TEST(Camera, OrthographicRaysAreParallel) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.position = {1.0, 2.0, 3.0};
  camera.half_height = 2.0;
  const CameraRay corner = camera_ray(camera, 1.5, 0.0, 0.0);
  EXPECT_EQ(corner.origin, Point3(1.0 - 3.0, 2.0 + 2.0, 3.0));
  EXPECT_EQ(corner.direction, camera.forward);
  EXPECT_EQ(camera_ray(camera, 1.5, 0.5, 0.5).origin, camera.position);
}

TEST(Camera, RaysStartInTheSectionPlane) {
  Camera camera = look_at({1.0, 2.0, 3.0}, Point3(-2.0, 1.0, 0.0), 0.9);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    camera.projection = projection;
    for (const double x : {0.0, 0.3, 1.0}) {
      camera.section = 0.0;
      const CameraRay whole = camera_ray(camera, 1.6, x, 0.2);
      camera.section = 2.5;
      const CameraRay cut = camera_ray(camera, 1.6, x, 0.2);
      EXPECT_EQ(cut.direction, whole.direction);
      EXPECT_NEAR(glm::dot(cut.origin - camera.position, camera.forward), 2.5, 8.0 * rounding);
      const Vec3 along = cut.origin - whole.origin; // on the same line
      EXPECT_LT(glm::length(glm::cross(along, whole.direction)), 8.0 * rounding);
    }
  }
}

/// Where a point is in a square picture: the larger of |x| and |y|, 1 at its border; more than that
/// behind the camera.
double off_centre(const Camera& camera, const Point3& point) {
  const Vec3 from_eye = point - camera.position;
  const double depth = glm::dot(from_eye, camera.forward) * std::tan(0.5 * camera.vertical_fov);
  const double off =
      std::max(std::abs(glm::dot(from_eye, camera.right)), std::abs(glm::dot(from_eye, camera.up)));
  return depth > 0.0 ? off / depth : 1e9;
}

void expect_sees(const Bounds& bounds) {
  const Camera camera = default_camera(bounds);
  EXPECT_NEAR(glm::dot(camera.right, camera.up), 0.0, rounding);
  EXPECT_NEAR(glm::dot(camera.right, camera.forward), 0.0, rounding);
  EXPECT_LT(glm::distance(glm::cross(camera.right, camera.up), -camera.forward), 4.0 * rounding);
  EXPECT_GT(camera.up.y, 0.0);
  const Point3 centre = 0.5 * (bounds.low + bounds.high);
  EXPECT_TRUE(glm::all(glm::greaterThan(camera.position, centre)));
  EXPECT_TRUE(glm::any(glm::greaterThan(camera.position, bounds.high))) << "the eye is inside";
  double farthest = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Point3 corner((k & 1) != 0 ? bounds.high.x : bounds.low.x,
                        (k & 2) != 0 ? bounds.high.y : bounds.low.y,
                        (k & 4) != 0 ? bounds.high.z : bounds.low.z);
    farthest = std::max(farthest, off_centre(camera, corner));
  }
  // All is in the picture with a tenth to spare, and more than a third of it is filled unless there
  // is nothing to see.
  EXPECT_LE(farthest, 0.92);
  if (glm::distance(bounds.low, bounds.high) > 1e-8 * glm::length(centre)) {
    EXPECT_GE(farthest, 0.35);
  }
}

TEST(DefaultCamera, SeesBoundsOfAnyShapeAndSize) {
  for (const double scale : {1e-6, 1.0, 1e9}) {
    for (const Vec3 size : {Vec3(1, 1, 1), Vec3(1, 0, 1), Vec3(0, 1, 0), Vec3(20, 1, 0.1),
                            Vec3(0.1, 3, 50), Vec3(0.0)}) {
      for (const Vec3 offset : {Vec3(0.0), Vec3(10, -20, 30)}) {
        expect_sees({scale * offset, scale * (offset + size)});
      }
    }
  }
}

TEST(DefaultCamera, SeesSmallThingsFarAway) {
  expect_sees({Point3(1e6), Point3(1e6) + Vec3(1e-3)});
  expect_sees({Point3(-1e6), Point3(-1e6)});
  expect_sees({Point3(1e15), Point3(1e15)});
}

TEST(DefaultCamera, IsFiniteWithoutAnything) {
  const Camera camera = default_camera({});
  EXPECT_TRUE(std::isfinite(glm::length(camera.position)));
  EXPECT_GT(glm::length(camera.position), 1.0);
}

} // namespace
} // namespace meninas::test
