// Alpha of BLEND: what a surface that is there in part covers, reflects and passes.
#include "tests/raytrace/glass_pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A sheet of that reflectance of which the share alpha is there.
Material veil(double alpha, double reflectance, double roughness = 1.0) {
  Material material = double_sided(diffuse(reflectance));
  material.alpha_mode = AlphaMode::blend;
  material.alpha = alpha;
  material.transmission = 1.0 - alpha;
  material.roughness = roughness;
  material.specular = 0.0;
  return material;
}

void add_floor(Scene& scene, double half, const Material& material) {
  add_polygon(scene, "floor",
              {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}}, material);
}

void add_sheet(Scene& scene, double height, const Material& material) {
  add_polygon(scene, "sheet", {{-9, height, 9}, {9, height, 9}, {9, height, -9}, {-9, height, -9}},
              material);
}

// L = (1 - a) L_behind + 0, whatever the roughness and the angle: openings do not blur.
TEST(Coverage, WhatIsBehindIsSeenInTheShareThatIsOpen) {
  for (const double roughness : {0.0, 0.3, 1.0})
    for (const Point3 eye : {Point3(0, 2, 0.1), Point3(4, 1.5, 0.1)}) {
      Scene scene;
      add_floor(scene, 9.0, diffuse(0.0, pi));
      add_sheet(scene, 1.0, veil(0.3, 0.0, roughness));
      EXPECT_NEAR(seen(scene, eye, Point3(0.0)).g, 0.7, 1e-6) << roughness;
      RenderSettings without_mirrors = one_pixel();
      without_mirrors.mode = RenderMode::radiosity;
      EXPECT_NEAR(seen(scene, eye, Point3(0.0), without_mirrors).g, 0.7, 1e-6) << roughness;
    }
}

// Two sheets pass (1 - a)^2.
TEST(Coverage, SheetsBehindOneAnotherMultiply) {
  Scene scene;
  add_floor(scene, 9.0, diffuse(0.0, pi));
  add_sheet(scene, 0.5, veil(0.3, 0.0));
  add_sheet(scene, 1.0, veil(0.6, 0.0));
  EXPECT_NEAR(seen(scene, {0, 2, 0.1}, Point3(0.0)).g, 0.7 * 0.4, 1e-6);
}

// A bulb, a lamp and the sun each light the floor with 1 - a of what they do without the sheet:
// not less at grazing angles, as panes do.
TEST(Coverage, LightPassesInTheShareThatIsOpen) {
  constexpr double rho = 1e-5; // too dark for light to come back
  const Point3 eye{0, 0.5, 0.4};
  for (int kind = 0; kind < 3; ++kind) {
    Scene scene;
    add_floor(scene, 3.0, diffuse(rho));
    if (kind == 0)
      scene.lights.push_back({.name = "bulb", .position = {6, 2, -3}});
    else if (kind == 1)
      add_polygon(scene, "lamp",
                  {{1.9, 2, -0.1}, {2.1, 2, -0.1}, {2.1, 2, 0.1}, {1.9, 2, 0.1}},
                  diffuse(0.0, 10.0));
    else
      scene.lights.push_back({.name = "sun",
                              .kind = PunctualKind::directional,
                              .direction = glm::normalize(Vec3(-3.0, -1.0, 0.0))});
    const double bare = seen(scene, eye, Point3(0.0)).g;
    ASSERT_GT(bare, 0.0);
    add_sheet(scene, 1.0, veil(0.15, 0.0));
    // 1e-3: of the lamp's shadow rays, whose weights differ.
    EXPECT_NEAR(seen(scene, eye, Point3(0.0)).g / bare, 0.85, 1e-3) << kind;
  }
}

// Its own light: a rho E / pi, from either side.
TEST(Coverage, ReflectsInTheShareThatIsThere) {
  Scene scene;
  add_sheet(scene, 0.0, veil(0.25, 0.8));
  scene.lights.push_back({.name = "bulb", .position = {0, 2, 0}});
  const double irradiance = 1.0 / 4.0;
  EXPECT_NEAR(seen(scene, {0, 1, 0.1}, Point3(0.0)).g, 0.25 * 0.8 * irradiance / pi, 2e-4);
}

// Whatever is there, light from everywhere is the same: E = 1 and rho = 1/2 of the walls make
// L = 2 / pi, and a white veil takes nothing of it.
TEST(Coverage, AWhiteVeilInAFurnaceIsNotSeen) {
  Scene scene = furnace(0.5, {});
  add_polygon(scene, "veil", {{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.8, 0.8, 0.5}, {0.2, 0.8, 0.5}},
              veil(0.4, 1.0));
  const Point3 target(0.5, 0.5, 0.5);
  // Half a percent is what 10 cm elements and their rays know of the furnace.
  for (const Point3 eye : {Point3(0.5, 0.5, 0.95), Point3(0.4, 0.6, 0.05)})
    EXPECT_NEAR(seen(scene, eye, target).g, 2.0 / pi, 0.005 * 2.0 / pi);
}

} // namespace
} // namespace meninas::test
