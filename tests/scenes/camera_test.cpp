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

Camera panorama(Projection projection) {
  Camera camera = look_at({1.0, 2.0, 3.0}, Point3(-2.0, 1.0, 0.0), 0.9);
  camera.projection = projection;
  camera.section = 2.5; // of other projections
  camera.lens_radius = 0.1;
  return camera;
}

void expect_direction(const Camera& camera, double x, double y, const Direction& expected) {
  const CameraRay ray = camera_ray(camera, 2.0, x, y);
  EXPECT_EQ(ray.origin, camera.position);
  EXPECT_LT(glm::distance(ray.direction, glm::normalize(expected)), 2.0 * rounding) << x << ' ' << y;
}

TEST(Panoramas, EquirectangularIsTheWholeSphere) {
  const Camera c = panorama(Projection::equirectangular);
  expect_direction(c, 0.5, 0.5, c.forward);
  expect_direction(c, 0.75, 0.5, c.right);
  expect_direction(c, 0.25, 0.5, -c.right);
  expect_direction(c, 0.0, 0.5, -c.forward);
  expect_direction(c, 1.0, 0.5, -c.forward);
  expect_direction(c, 0.3, 0.0, c.up);
  expect_direction(c, 0.3, 1.0, -c.up);
  expect_direction(c, 0.625, 0.25, std::sqrt(0.5) * (c.right + c.forward) + c.up);
  EXPECT_EQ(natural_aspect(c), 2.0);
}

TEST(Panoramas, TheFacesOfACubeMeetWhereOneLooksAhead) {
  const Camera c = panorama(Projection::cube);
  const std::array middles{c.right, -c.right, c.up, -c.up, c.forward, -c.forward};
  for (int face = 0; face < 6; ++face)
    expect_direction(c, (face + 0.5) / 6.0, 0.5, middles[static_cast<std::size_t>(face)]);
  const double right_end = 1.0 - 1e-9;
  for (const double place : {0.0, 0.2, 0.7}) {
    const auto at = [&](int face, double x, double y) { return std::pair((face + x) / 6.0, y); };
    const auto expect_met = [&](std::pair<double, double> a, std::pair<double, double> b) {
      EXPECT_LT(glm::distance(camera_ray(c, 6.0, a.first, a.second).direction,
                              camera_ray(c, 6.0, b.first, b.second).direction), 1e-8);
    };
    expect_met(at(2, place, 1.0), at(4, place, 0.0));             // up and ahead
    expect_met(at(3, place, 0.0), at(4, place, 1.0));             // down and ahead
    expect_met(at(4, right_end, place), at(0, 0.0, place));       // ahead and right
    expect_met(at(1, right_end, place), at(4, 0.0, place));       // left and ahead
    expect_met(at(0, right_end, place), at(5, 0.0, place));       // right and behind
  }
  EXPECT_EQ(natural_aspect(c), 6.0);
}

TEST(Lens, RaysMeetInThePlaneOfFocusAndSpreadByTheirDepth) {
  Camera camera = look_at({1.0, 2.0, 3.0}, Point3(-2.0, 1.0, 0.0), 0.9);
  const CameraRay sharp = camera_ray(camera, 1.6, 0.3, 0.2);
  camera.lens_radius = 0.2;
  camera.focus_distance = 2.0;
  const auto at_depth = [&](const CameraRay& ray, double z) {
    const double along = glm::dot(ray.direction, camera.forward);
    const double before = glm::dot(ray.origin - camera.position, camera.forward);
    return ray.origin + (z - before) / along * ray.direction;
  };
  for (const double section : {0.0, 0.5})
    for (const Vec2 lens : {Vec2(0.0), Vec2(1.0, 0.0), Vec2(-0.6, 0.8)}) {
      camera.section = section;
      const CameraRay ray = camera_ray(camera, 1.6, 0.3, 0.2, lens);
      EXPECT_NEAR(glm::length(ray.direction), 1.0, rounding);
      EXPECT_LT(glm::distance(at_depth(ray, 2.0), at_depth(sharp, 2.0)), 8.0 * rounding);
      for (const double z : {0.5, 3.0})
        EXPECT_NEAR(glm::distance(at_depth(ray, z), at_depth(sharp, z)),
                    0.2 * glm::length(lens) * std::abs(z - 2.0) / 2.0, 8.0 * rounding);
    }
}

// A file that asks for 60 degrees across a frame of 3 : 2.
TEST(SensorFit, KeepsTheSideThatItSays) {
  Camera camera;
  camera.aspect = 1.5;
  const double half_width = std::tan(0.5 * 1.0471975511965976);
  camera.vertical_fov = 2.0 * std::atan(half_width / 1.5);
  const auto half_height = [&](SensorFit fit, double picture_aspect) {
    camera.sensor_fit = fit;
    return half_height_of(camera, picture_aspect);
  };
  for (const SensorFit fit : {SensorFit::vertical, SensorFit::horizontal, SensorFit::longer})
    EXPECT_NEAR(half_height(fit, 1.5), half_width / 1.5, rounding) << "in the frame of the file";
  EXPECT_NEAR(half_height(SensorFit::vertical, 0.5), half_width / 1.5, rounding);
  EXPECT_NEAR(half_height(SensorFit::horizontal, 0.5), half_width / 0.5, rounding);
  EXPECT_NEAR(half_height(SensorFit::longer, 2.0), half_width / 2.0, rounding);
  EXPECT_NEAR(half_height(SensorFit::longer, 0.5), half_width, rounding) << "upright, the height";
  camera.aspect = 0.0;
  EXPECT_NEAR(half_height(SensorFit::horizontal, 0.5), std::tan(0.5 * camera.vertical_fov), rounding);
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
