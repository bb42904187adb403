// Flat lights that are no faces: the path tracer against closed forms and in all its ways of finding light,
// and the two passes against it.
#include "form_factors/point_form_factor.h"
#include "raytrace/two_pass.h"
#include "tests/reference/agreement.h"
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using reference::LightSearch;

constexpr double pi = std::numbers::pi;

/// A level rectangle that shines downwards.
AreaLight panel(const Point3& at, double a, double b, const Rgb& radiance) {
  AreaLight light;
  light.name = "panel";
  light.axis = {0.0, -1.0, 0.0};
  light.radiance = radiance;
  light.corners = {at + Vec3(-a, 0, -b) / 2.0, at + Vec3(a, 0, -b) / 2.0, at + Vec3(a, 0, b) / 2.0,
                   at + Vec3(-a, 0, b) / 2.0};
  return light;
}

/// A room whose wall x = 0 is a mirror, with a large panel that hangs at half of its height.
Scene room_with_panel() {
  Scene scene = half_room();
  for (Material& material : scene.materials)
    material.emission = Rgb(0.0);
  scene.area_lights = {panel({0.9, 1.3, 1.6}, 1.0, 1.2, Rgb(4.0, 3.0, 2.0))};
  return scene;
}

TEST(AreaLightPaths, LightAFloorByLambertsFormula) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 3}, {3, 0, 3}, {3, 0, 0}, {0, 0, 0}}, diffuse(0.5));
  scene.area_lights = {panel({1.5, 1.0, 1.5}, 0.8, 0.5, Rgb(4.0, 3.0, 2.0)), panel({2.5, 0.7, 1.0}, 0.2, 0.3, Rgb(8.0))};
  for (const Point3& x : {Point3(1.5, 0.0, 1.5), Point3(2.3, 0.0, 0.4)}) {
    Rgb exact(0.0);
    for (const AreaLight& light : scene.area_lights)
      exact += 0.5 * light.radiance * point_form_factor(x, {0, 1, 0}, light.corners);
    expect_radiance(radiance_seen(scene, {0.5, 2.0, 2.9}, x, 4096), exact);
  }
}

TEST(AreaLightPaths, TheEyeSeesNoneAndMirrorsDo) {
  Scene scene;
  add_polygon(scene, "mirror", {{0, 0, 3}, {3, 0, 3}, {3, 0, 0}, {0, 0, 0}}, mirror(0.75));
  scene.area_lights = {panel({1.5, 1.0, 1.5}, 0.8, 0.5, Rgb(4.0, 3.0, 2.0))};
  EXPECT_EQ(radiance_seen(scene, {1.5, 0.2, 1.6}, {1.5, 1.0, 1.5}, 16).mean, Rgb(0.0)) << "its front";
  EXPECT_EQ(radiance_seen(scene, {1.5, 2.0, 1.6}, {1.5, 1.0, 1.5}, 16).mean.r, 0.75 * 4.0)
      << "through its back, in the mirror below";
  EXPECT_EQ(radiance_seen(scene, {2.9, 2.0, 1.5}, {2.6, 0.0, 1.5}, 16).mean, Rgb(0.0)) << "beside it";
}

TEST(AreaLightPaths, AreFoundInEveryWay) {
  const Scene scene = room_with_panel();
  const Camera camera = look_at({1.6, 1.1, 2.7}, {0.3, 0.9, 0.6}, 1.0);
  const auto by = [&](LightSearch search, int samples) {
    auto settings = tracing(12, 12, samples);
    settings.search = search;
    return mean_radiance(traced_picture(scene, camera, settings));
  };
  const MeanRadiance both = by(LightSearch::both, 1024);
  for (const MeanRadiance& other : {by(LightSearch::choosing, 1024), by(LightSearch::meeting, 2048)})
    for (int band = 0; band < 3; ++band) {
      const double error = std::hypot(both.error[band], other.error[band]);
      EXPECT_LT(error, 0.02 * both.mean[band]) << "too noisy to tell";
      EXPECT_NEAR(both.mean[band], other.mean[band], 4.0 * error) << band;
    }
}

/// With direct light at hits, and by the field alone.
void expect_both_terms(const Scene& scene, std::initializer_list<Sight> sights) {
  for (const DiffuseTerm term : {DiffuseTerm::direct, DiffuseTerm::interpolated})
    expect_agreement(scene, sights, {.term = term, .paths = 1024, .noise = 0.02});
}

TEST(AreaLightPictures, AgreeWithPathsAlsoAboveTheLightAndInAMirror) {
  expect_both_terms(room_with_panel(), {{"the ceiling above it", {1.5, 0.8, 2.5}, {0.5, 2.4, 1.3}},
                                       {"the floor", {1.5, 1.5, 1.2}, {0.6, 0.0, 2.6}},
                                       {"a wall", {0.3, 1.5, 1.5}, {2.0, 0.7, 1.0}},
                                       {"the light in the mirror", {1.9, 0.2, 1.6}, {0.0, 0.83, 1.6}},
                                       {"its back in the mirror", {1.9, 2.3, 1.6}, {0.0, 1.75, 1.6}},
                                       {"the wall behind it in the mirror", {1.9, 1.5, 2.8}, {0.0, 1.0, 1.5}}});
}

TEST(AreaLightPictures, AgreeWithPathsInGloss) {
  Scene scene = room_with_panel();
  for (const double roughness : {0.15, 0.4}) {
    Scene glossy = scene;
    Material metal = mirror(0.8);
    metal.roughness = roughness;
    add_polygon(glossy, "tray", {{0.2, 0.3, 2.6}, {1.8, 0.3, 2.6}, {1.8, 0.3, 1.4}, {0.2, 0.3, 1.4}}, metal);
    expect_both_terms(glossy, {{"in the lobe", {1.0, 1.1, 2.9}, {0.95, 0.3, 2.2}}, {"at its rim", {1.9, 1.0, 2.9}, {1.2, 0.3, 2.5}}});
  }
}

} // namespace
} // namespace meninas::test
