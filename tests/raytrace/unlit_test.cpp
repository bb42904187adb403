// KHR_materials_unlit: shown as it is, by way of mirrors too, and no lamp.
#include "tests/raytrace/glass_pictures.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

Material unlit(Rgb colour) {
  Material material = double_sided(diffuse(colour));
  material.unlit = true;
  return material;
}

void add_floor(Scene& scene, double height, const Material& material) {
  add_polygon(scene, "floor",
              {{-3, height, 3}, {3, height, 3}, {3, height, -3}, {-3, height, -3}}, material);
}

const Rgb colour(0.2, 0.5, 0.9);

void expect_colour(const glm::dvec3& found, const Rgb& expected) {
  EXPECT_LT(glm::distance(found, expected), 1e-6);
}

TEST(Unlit, ShowsItsColourInTheDarkAndInTheLight) {
  Scene scene;
  add_floor(scene, 0.0, unlit(colour));
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0)), colour);
  scene.lights.push_back({.name = "bulb", .intensity = Rgb(50.0), .position = {0, 2, 0}});
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0)), colour);
  RenderSettings interpolated = one_pixel();
  interpolated.diffuse.term = DiffuseTerm::interpolated;
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0), interpolated), colour);
}

TEST(Unlit, IsSeenInMirrorsWithTheirReflectance) {
  Scene scene;
  add_floor(scene, 0.0, mirror(0.5));
  add_floor(scene, 2.0, unlit(colour));
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0)), 0.5 * colour);
}

TEST(Unlit, IsOpenInItsShare) {
  Scene scene;
  add_floor(scene, 0.0, unlit(Rgb(1.0)));
  Material veil = unlit(colour);
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha = 0.25;
  veil.transmission = 0.75;
  add_floor(scene, 0.5, veil);
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0)), 0.25 * colour + 0.75);
}

// The other surface is lit by nothing: what is unlit is no lamp.
TEST(Unlit, LightsNothing) {
  Scene scene;
  add_floor(scene, 0.0, diffuse(0.8));
  add_floor(scene, 2.0, unlit(colour));
  expect_colour(seen(scene, {0, 1, 0.1}, Point3(0.0)), Rgb(0.0));
}

// To the light of others it is diffuse: under a lamp it sends back rho, as a matt surface would.
TEST(Unlit, ReflectsAsADiffuseSurfaceForOthers) {
  const auto floor_under = [](const Material& ceiling) {
    Scene scene;
    add_floor(scene, 0.0, diffuse(0.8));
    add_polygon(scene, "ceiling", {{-3, 2, -3}, {3, 2, -3}, {3, 2, 3}, {-3, 2, 3}}, ceiling);
    scene.lights.push_back({.name = "bulb", .position = {0, 1, 0}});
    RenderSettings settings = one_pixel();
    settings.diffuse.term = DiffuseTerm::gather;
    return seen(scene, {0, 0.5, 0.1}, Point3(0.0), settings);
  };
  Material shown = diffuse(colour);
  shown.unlit = true;
  EXPECT_EQ(floor_under(shown), floor_under(diffuse(colour)));
}

} // namespace
} // namespace meninas::test
