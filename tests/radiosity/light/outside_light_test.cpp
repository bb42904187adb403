// Light that no surface emits: of punctual lights, also by way of mirrors, and of the background.
#include "form_factors/point_form_factor.h"
#include "radiosity/light/direct_irradiance.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double rho = 0.9;

PunctualLight point_light(const Point3& position, double intensity) {
  PunctualLight light;
  light.intensity = Rgb(intensity);
  light.position = position;
  return light;
}

/// A floor about the origin, and a mirror on the plane x = 0 from height 1 to height 2.
Scene floor_and_mirror() {
  Scene scene;
  add_polygon(scene, "floor", {{0.1, 0, 3}, {4, 0, 3}, {4, 0, -3}, {0.1, 0, -3}}, diffuse(0.5));
  add_polygon(scene, "mirror", {{0, 1, 3}, {0, 1, -3}, {0, 2, -3}, {0, 2, 3}}, mirror(rho));
  return scene;
}

ArrivingLight arriving(const Scene& scene, const Point3& x, const Direction& normal) {
  const auto l = lit(scene, {.element_size = 1.0});
  const PlaneId floor = l->mesh.sides.empty() ? none<PlaneId> : l->mesh.sides[0].plane_class;
  DirectWorkspace work;
  return direct_irradiance(*l->light, {x, normal, floor, Vec3(0.0)}, {}, 0, work);
}

/// E = I cos / d^2 on a horizontal floor.
double closed_form(double intensity, const Point3& light, const Point3& x) {
  const Vec3 to = light - x;
  const double d2 = glm::dot(to, to);
  return intensity * to.y / (d2 * std::sqrt(d2));
}

TEST(PunctualLight, ItsImageInAMirrorIsOneMoreLight) {
  Scene scene = floor_and_mirror();
  const Point3 lamp{1.0, 2.5, 0.3}, image{-1.0, 2.5, 0.3};
  scene.lights = {point_light(lamp, 30.0)};
  int through = 0, beside = 0;
  for (double x = 0.2; x < 4.0; x += 0.05) {
    const Point3 at{x, 0.0, -0.2};
    // The line from the image crosses x = 0 at the height 2.5 x / (1 + x):
    // the window is from 1 to 2.
    const double height = 2.5 * x / (1.0 + x);
    if (std::abs(height - 1.0) < 1e-6 || std::abs(height - 2.0) < 1e-6)
      continue; // on the window's edge rounding decides
    const bool seen = height > 1.0 && height < 2.0;
    ++(seen ? through : beside);
    const double straight = closed_form(30.0, lamp, at);
    const double mirrored = seen ? rho * closed_form(30.0, image, at) : 0.0;
    const ArrivingLight light = arriving(scene, at, {0, 1, 0});
    EXPECT_NEAR(light.total.g, straight + mirrored, 1e-12 * straight) << x;
    EXPECT_NEAR(light.mirrored.g, mirrored, 1e-12 * straight) << x;
    EXPECT_EQ(light.punctual, light.total) << x;
  }
  EXPECT_GT(through, 5);
  EXPECT_GT(beside, 5);
}

TEST(PunctualLight, EveryLegCanBeBlocked) {
  Scene scene = floor_and_mirror();
  const Point3 at{1.5, 0.0, 0.3}, lamp{1.0, 2.5, 0.3};
  scene.lights = {point_light(lamp, 1.0)};
  const double straight = closed_form(1.0, lamp, at);
  const double both = straight + rho * closed_form(1.0, {-1.0, 2.5, 0.3}, at);
  // The path by the mirror turns at height 1.5;
  // blades across its legs, low before and high behind the mirror.
  constexpr double x = 0.5; // both legs fall at 45 degrees
  for (const double height : {1.0, 2.0}) {
    Scene blocked = scene;
    add_polygon(blocked, "blade",
                {{x - 0.1, height, 0.1},
                 {x - 0.1, height, 0.5},
                 {x + 0.1, height, 0.5},
                 {x + 0.1, height, 0.1}},
                double_sided(diffuse(0.0)));
    EXPECT_NEAR(arriving(blocked, at, {0, 1, 0}).total.g, straight, 1e-12) << height;
  }
  EXPECT_NEAR(arriving(scene, at, {0, 1, 0}).total.g, both, 1e-12);
}

TEST(PunctualLight, ASpotFallsFromItsInnerToItsOuterCone) {
  Scene scene = floor_and_mirror();
  PunctualLight spot = point_light({2.0, 1.0, 0.0}, 8.0);
  spot.kind = PunctualKind::spot;
  spot.direction = {0, -1, 0};
  spot.inner_cone = 0.3;
  spot.outer_cone = 0.6;
  scene.lights = {spot};
  for (const double angle : {0.0, 0.29, 0.45, 0.61}) {
    // KHR_lights_punctual: ((cos - cos_outer) / (cos_inner - cos_outer))^2 in between
    const double t = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    const double fall = angle < 0.3 ? 1.0 : angle > 0.6 ? 0.0 : t * t;
    const double cosine = std::cos(angle);
    EXPECT_NEAR(arriving(scene, {2.0 + std::tan(angle), 0, 0}, {0, 1, 0}).total.g,
                8.0 * fall * cosine * cosine * cosine, 1e-9)
        << angle;
  }
}

TEST(PunctualLight, DirectionalLightComesOffAMirrorAsADirection) {
  // Light that falls towards -x at 45 degrees meets the mirror and comes back towards +x:
  // a band of the floor has both.
  Scene scene = floor_and_mirror();
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.intensity = Rgb(5.0);
  sun.direction = glm::normalize(Vec3(-1, -1, 0));
  scene.lights = {sun};
  const double straight = 5.0 * std::sqrt(0.5);
  EXPECT_NEAR(arriving(scene, {1.5, 0, 0}, {0, 1, 0}).total.g, (1.0 + rho) * straight, 1e-9);
  EXPECT_NEAR(arriving(scene, {2.5, 0, 0}, {0, 1, 0}).total.g, straight, 1e-9);
  EXPECT_EQ(arriving(scene, {1.5, 0, 0}, {0, -1, 0}).total.g, 0.0);
}

TEST(PunctualLight, ElementsAndVerticesReceiveIt) {
  Scene scene = floor_and_mirror();
  scene.lights = {point_light({2.0, 2.0, 0.0}, 10.0)};
  const auto l = lit(scene, {.element_size = 0.25});
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 16;
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  for (std::size_t v = 0; v < l->mesh.vertices.size(); ++v) {
    const Point3& x = l->mesh.vertices[v];
    if (x.x < 2.05 || x.x > 3.0)
      continue; // beside the edges of the mirrored light
    // Vertices gather 2 % of half an element towards the middle of theirs.
    const double exact =
        closed_form(10.0, {2.0, 2.0, 0.0}, x) + rho * closed_form(10.0, {-2.0, 2.0, 0.0}, x);
    EXPECT_NEAR(solution.field.irradiance[v].g, exact, 0.01 * exact) << x.x << ' ' << x.z;
  }
  // What arrives is absorbed by half, reflected into the open by half, and no more.
  EXPECT_NEAR(solution.energy.imbalance, 0.0, 0.02);
  EXPECT_GT(solution.energy.emitted.g, 0.0);
}

TEST(Background, AnOpenFloorReceivesPiTimesItsRadianceByEverySolver) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, diffuse(0.5));
  scene.background = Rgb(0.5, 1.0, 2.0);
  const auto l = lit(scene, {.element_size = 0.5});
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 16;
  for (const FormFactorMethod method :
       {FormFactorMethod::rays, FormFactorMethod::hemicube, FormFactorMethod::analytic})
    for (const SolverMethod solver : {SolverMethod::bicgstab, SolverMethod::progressive}) {
      settings.form_factors.method = method;
      settings.solver.method = solver;
      const RadiositySolution solution = solve_pass_one(l->light, settings);
      for (const auto& h : solution.field.irradiance)
        EXPECT_LE(glm::distance(Rgb(h), std::numbers::pi * scene.background.constant), 1e-5);
      EXPECT_NEAR(solution.energy.imbalance, 0.0, 1e-6);
    }
}

TEST(Background, HalfOfItMayComeByWayOfAMirror) {
  // At the foot of an endless mirror half of the hemisphere shows the sky in it.
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 1}, {1e-3, 0, 1}, {1e-3, 0, -1}, {0, 0, -1}}, diffuse(0.5));
  add_polygon(scene, "mirror", {{0, 0, 1e3}, {0, 0, -1e3}, {0, 1e3, -1e3}, {0, 1e3, 1e3}},
              mirror(rho));
  scene.background = Rgb(1.0);
  const auto l = lit(scene, {.element_size = 1.0});
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 1024;
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  for (std::size_t v = 0; v < solution.field.irradiance.size(); ++v) {
    EXPECT_NEAR(solution.field.irradiance[v].g, 0.5 * (1.0 + rho) * std::numbers::pi, 0.01);
    EXPECT_NEAR(solution.field.mirrored[v].g, 0.5 * rho * std::numbers::pi, 0.01);
  }
}

TEST(GlowingMirrors, SendNothingByWayOfThemselves) {
  // A sheet that glows and mirrors on both sides, upright over the floor:
  // of its light a point gets that of the side that it sees.
  Scene scene;
  add_polygon(scene, "floor", {{0.1, 0, 3}, {4, 0, 3}, {4, 0, -3}, {0.1, 0, -3}}, diffuse(0.5));
  Material sheet = double_sided(mirror(rho));
  sheet.emission = Rgb(1.0 / std::numbers::pi);
  const std::vector<Point3> corners{{0, 1, 1}, {0, 1, -1}, {0, 2, -1}, {0, 2, 1}};
  add_polygon(scene, "sheet", corners, sheet);
  const Point3 at{1.0, 0.0, 0.2};
  const ArrivingLight light = arriving(scene, at, {0, 1, 0});
  EXPECT_NEAR(light.total.g, point_form_factor(at, {0, 1, 0}, corners), 1e-9);
  EXPECT_EQ(light.mirrored.g, 0.0);
}

} // namespace
} // namespace meninas::test
