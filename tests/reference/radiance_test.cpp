// Radiances that are known in closed form.
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// Radiance in a furnace of emitted radiosity 1:
/// E / (1 - rho) / pi, wherever one looks, whichever walls are perfect mirrors.
class ReferenceFurnace : public testing::TestWithParam<std::pair<double, std::array<bool, 6>>> {};

TEST_P(ReferenceFurnace, IsEvenlyBright) {
  const auto& [rho, mirrors] = GetParam();
  const Scene scene = furnace(rho, mirrors);
  const Camera camera = look_at({0.3, 0.4, 0.6}, {0.7, 0.5, 0.1}, 1.2);
  const auto picture = traced_picture(scene, camera, tracing(8, 8, 256));
  expect_radiance(mean_radiance(picture), Rgb(1.0 / (1.0 - rho) / pi));
}

INSTANTIATE_TEST_SUITE_P(
    Reflectances, ReferenceFurnace,
    testing::Values(std::pair(0.0, std::array<bool, 6>{}), std::pair(0.5, std::array<bool, 6>{}),
                    std::pair(0.9, std::array<bool, 6>{}),
                    std::pair(0.5, std::array{true, false, false, false, false, false}),
                    std::pair(0.5, std::array{true, true, false, false, false, false}),
                    std::pair(0.7, std::array{true, false, true, false, true, false})));

/// The factor from a point to a parallel rectangle over it,
/// one of whose corners is a height h straight above: a classic, e.g.
/// Siegel and Howell, configuration B-4.
double corner_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * pi);
}

/// A floor at y = 0 and a lamp over its origin that shines downwards.
Scene floor_and_lamp(double half, double height, const Rgb& reflectance) {
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}},
              diffuse(reflectance));
  add_polygon(
      scene, "lamp",
      {{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}},
      diffuse(Rgb(0.0), Rgb(5.0)));
  return scene;
}

TEST(ReferenceRadiance, FloorUnderASquareLamp) {
  const Rgb rho(0.8, 0.5, 0.1);
  for (const auto& [half, height] :
       {std::pair(0.5, 1.0), std::pair(0.01, 1.0), std::pair(2.0, 0.2)}) {
    const double irradiance = 5.0 * 4.0 * corner_factor(half, half, height);
    expect_radiance(
        radiance_seen(floor_and_lamp(half, height, rho), {4, 0.15, 1}, Point3(0.0), 256),
        rho * irradiance / pi);
  }
}

TEST(ReferenceRadiance, AnEmitterHasItsOwnInFrontAndNoneBehind) {
  const Scene scene = floor_and_lamp(0.5, 1.0, Rgb(0.5));
  expect_radiance(radiance_seen(scene, {0, 0.5, 0.1}, {0, 1, 0}, 32), Rgb(5.0 / pi));
  // The back is transparent to the eye: it sees the floor.
  const double irradiance = 5.0 * 4.0 * corner_factor(0.5, 0.5, 1.0);
  expect_radiance(radiance_seen(scene, {0, 2, 0.01}, {0, 0, 0}, 256), Rgb(0.5 * irradiance / pi));
}

/// A lamp before one mirror or between two that face each other.
Scene lamp_before_mirrors(const Rgb& reflectance) {
  Scene scene;
  Material glass = mirror(1.0);
  glass.base_color = reflectance;
  add_polygon(scene, "low", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, glass);
  add_polygon(scene, "high", {{-9, 1, -9}, {9, 1, -9}, {9, 1, 9}, {-9, 1, 9}}, glass);
  add_polygon(scene, "lamp", {{3, 0, -1}, {3, 0, 1}, {3, 1, 1}, {3, 1, -1}},
              diffuse(Rgb(0.0), Rgb(pi)));
  return scene;
}

TEST(ReferenceRadiance, MirrorImagesOfAnEmitter) {
  const Rgb rho(0.9, 0.5, 0.25);
  const Scene scene = lamp_before_mirrors(rho);
  for (int k = 0; k <= 5; ++k) {
    // The k-th image of the lamp is centred k heights up.
    const Point3 eye{0, 0.5, 0};
    expect_radiance(radiance_seen(scene, eye, {3, 0.5 + k, 0}, 512), glm::pow(rho, Rgb(k)), 0.03);
  }
}

TEST(ReferenceRadiance, BacksAreBlackInMirrors) {
  Scene scene = floor_and_lamp(0.5, 1.0, Rgb(0.5));
  add_polygon(scene, "mirror", {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}}, mirror(0.9));
  EXPECT_EQ(radiance_seen(scene, {0, 2, 0.0}, {0, 3, 1e-6}, 32).mean, Rgb(0.0));
}

TEST(ReferenceRadiance, NothingIsBlack) {
  const Scene scene = floor_and_lamp(0.5, 1.0, Rgb(0.5));
  EXPECT_EQ(radiance_seen(scene, {0, 2, 0.0}, {0, 3, 1e-6}, 32).mean, Rgb(0.0));
}

TEST(ReferenceRadiance, PointAndSpotLightFollowTheInverseSquare) {
  Scene scene = floor_and_lamp(0.5, 1.0, Rgb(0.5));
  scene.materials[1].emission = Rgb(0.0);
  scene.triangles.resize(2);
  PunctualLight light{
      .name = "bulb", .kind = PunctualKind::point, .intensity = {3, 2, 1}, .position = {1, 2, 0}};
  // At the origin: cos = 2 / sqrt 5, distance^2 = 5.
  const double falloff = 2.0 / std::sqrt(5.0) / 5.0;
  scene.lights = {light};
  expect_radiance(radiance_seen(scene, {4, 1, 1}, Point3(0.0), 32),
                  Rgb(3, 2, 1) * (falloff * 0.5 / pi));
  light.kind = PunctualKind::spot;
  light.direction = glm::normalize(Vec3(-1, -2, 0));
  light.inner_cone = 0.2;
  light.outer_cone = 0.4;
  scene.lights = {light};
  expect_radiance(radiance_seen(scene, {4, 1, 1}, Point3(0.0), 32),
                  Rgb(3, 2, 1) * (falloff * 0.5 / pi));
  // 0.3 off the axis: the square of the share of the cosines (KHR_lights_punctual).
  const double off = std::atan2(1.0, 2.0) - 0.3;
  const Point3 there{1.0 - 2.0 * std::tan(off), 0.0, 0.0};
  const double fall = (std::cos(0.3) - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4));
  const double distance = 2.0 / std::cos(off);
  expect_radiance(radiance_seen(scene, {4, 1, 1}, there, 32),
                  Rgb(3, 2, 1) * (fall * fall * std::cos(off) / (distance * distance) * 0.5 / pi));
}

TEST(ReferenceRadiance, APointLightByWayOfAMirror) {
  // So dark a floor that what it sends to the mirror does not come back.
  constexpr double rho = 1e-6;
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, diffuse(rho));
  add_polygon(scene, "mirror", {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}}, mirror(0.8));
  add_polygon(scene, "shield", {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, diffuse(0.0));
  scene.lights = {{.name = "bulb",
                   .kind = PunctualKind::point,
                   .intensity = Rgb(3, 2, 1),
                   .position = {0, 2, 0}}};
  // Past the shield the floor at x = 4 sees the light,
  // distance^2 20, and its image at y = 4, distance^2 32.
  const double direct = 2.0 / std::sqrt(20.0) / 20.0, image = std::sqrt(0.5) / 32.0;
  const Rgb lit = Rgb(3, 2, 1) * ((direct + 0.8 * image) * rho / pi);
  expect_radiance(radiance_seen(scene, {6, 1, 1}, {4, 0, 0}, 32), lit);
  // From x = 1.5 the shield hides the light,
  // passed at x = 0.75, but not the image, passed at x = 1.125.
  const double near = 4.0 / std::pow(1.5 * 1.5 + 16.0, 1.5);
  expect_radiance(radiance_seen(scene, {1.6, 0.5, 0.1}, {1.5, 0, 0}, 32),
                  Rgb(3, 2, 1) * (0.8 * near * rho / pi));
  // Under it there is neither.
  EXPECT_LT(radiance_seen(scene, {0.5, 0.5, 0.5}, {0.1, 0, 0.2}, 32).mean.r, 1e-4 * lit.r);
}

TEST(ReferenceRadiance, DirectionalLight) {
  Scene scene = floor_and_lamp(0.5, 1.0, Rgb(0.5));
  scene.materials[1].emission = Rgb(0.0);
  PunctualLight light{.name = "sun", .kind = PunctualKind::directional, .intensity = {3, 2, 1}};
  light.direction = glm::normalize(Vec3(1, -1, 0));
  scene.lights = {light};
  expect_radiance(radiance_seen(scene, {4, 1, 1}, Point3(0.0), 32),
                  Rgb(3, 2, 1) * (std::sqrt(0.5) * 0.5 / pi));
  // In the shadow of what was the lamp, whose back blocks light.
  EXPECT_EQ(radiance_seen(scene, {4, 0.5, 1}, {1, 0, 0}, 32).mean, Rgb(0.0));
}

} // namespace
} // namespace meninas::test
