// The sky as the eye sees it: straight, in mirrors, through glass and in lobes; and the sun by a window.
#include "tests/raytrace/pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/metals.h"
#include "tests/support/skies.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

PassOneSettings pass_one(double element_size, int rays) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  return settings;
}

/// A pixel's worth of a narrow view.
glm::vec3 seen(const Scene& scene, const Point3& eye, const Point3& target,
               DiffuseTerm term = DiffuseTerm::direct) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 64;
  settings.glossy_samples = 256;
  settings.diffuse.term = term;
  return picture(lit_up(scene, pass_one(0.5, 64)), look_at(eye, target, 1e-3), settings).pixels[0];
}

Rgb patterned(const Direction& d) {
  return {1.0 + d.x, 1.5 + d.y, 1.2 + d.z};
}

Scene floor_of(const Material& material) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, material);
  scene.background = sky_of(patterned, 512);
  return scene;
}

void expect_colour(const glm::vec3& found, const Rgb& exact, double error) {
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(found[band], exact[band], error * exact[band]) << band;
}

TEST(SkyPictures, RaysThatMeetNothingShowTheSkyTheyPointTo) {
  const Scene scene = floor_of(diffuse(0.5));
  for (const Direction& d : {Direction(0.6, 0.64, -0.48), Direction(-0.36, 0.48, 0.8)})
    for (const DiffuseTerm term : {DiffuseTerm::direct, DiffuseTerm::interpolated})
      expect_colour(seen(scene, {0, 1, 0}, Point3(0, 1, 0) + d, term), patterned(d), 2e-3);
}

TEST(SkyPictures, AMirrorFloorShowsTheReflectedDirection) {
  const Scene scene = floor_of(mirror(0.8));
  const Vec3 down = glm::normalize(Vec3(0.7, -0.5, 0.3));
  for (const DiffuseTerm term : {DiffuseTerm::direct, DiffuseTerm::interpolated})
    expect_colour(seen(scene, Point3(0.0) - down, Point3(0.0), term),
                  0.8 * patterned({down.x, -down.y, down.z}), 2e-3);
}

TEST(SkyPictures, APaneShowsTheSkyBehindIt) {
  Scene scene;
  add_polygon(scene, "pane", {{2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}},
              double_sided(glass(Rgb(1.0))));
  scene.background = sky_of(patterned, 512);
  // At right angles the pane passes T and reflects 1 - T.
  const double passed = pane_transmittance(1.5, 1.0);
  expect_colour(seen(scene, {0, 0, 0}, {2, 0, 0}),
                passed * patterned({1, 0, 0}) + (1.0 - passed) * patterned({-1, 0, 0}), 5e-3);
}

TEST(SkyPictures, LobesShowAnEvenMapAsTheBackground) {
  Scene scene = floor_of(metal(Rgb(0.9, 0.7, 0.4), 0.4));
  scene.background = sky_of([](const Direction&) { return Rgb(1.0, 2.0, 3.0); });
  const glm::vec3 by_map = seen(scene, {1, 1, 0}, {0, 0, 0});
  scene.background = Rgb(1.0, 2.0, 3.0);
  const glm::vec3 by_background = seen(scene, {1, 1, 0}, {0, 0, 0});
  EXPECT_LT(glm::distance(by_map, by_background), 1e-4F * glm::length(by_background));
}

/// A mirror of a little roughness shows a small sun by its light, and not once more by its texels.
TEST(SkyPictures, SunsCountOnceInLobes) {
  const Direction sun = glm::normalize(Vec3(-1.0, 1.0, 0.0));
  const auto sky = [&](double strength) {
    return sky_of([&](const Direction& d) { return Rgb(glm::dot(d, sun) > std::cos(0.01) ? strength : 1.0); }, 2048);
  };
  Scene scene = floor_of(metal(Rgb(1.0), 0.5));
  scene.background = sky(1e5);
  ASSERT_EQ(scene.background.map->suns.size(), 1U);
  const double irradiance = scene.background.map->suns[0].irradiance.g;
  const glm::vec3 found = seen(scene, {1, 1, 0}, {0, 0, 0});
  // The same sun as a directional light under the sky without it.
  Scene apart = scene;
  apart.background = sky(1.0);
  apart.lights = {{.name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(irradiance),
                   .direction = -scene.background.map->suns[0].towards}};
  const glm::vec3 expected = seen(apart, {1, 1, 0}, {0, 0, 0});
  EXPECT_NEAR(found.g, expected.g, 0.02 * expected.g);
  EXPECT_GT(found.g, 3.0F);
}

// The sun through the window of 1.4 x 1.2 m onto the floor: its patch has the window's edges along
// the sun's direction, E sin e inside and no sun outside.
TEST(SkyPictures, TheSunThroughAWindowDrawsItOnTheFloor) {
  Scene scene = room_with_window(diffuse(0.5));
  const Direction sun = glm::normalize(Vec3(1.0, 1.0, 0.2));
  scene.lights = {{.name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(100.0), .direction = -sun}};
  scene.background = sky_of([](const Direction& d) { return Rgb(0.2 + 0.2 * std::max(0.0, d.y)); });
  const auto on_floor = [&](double height, double z) {
    const Point3 y{4.0, height, z};
    return y - y.y / sun.y * sun;
  };
  const auto light_at = [&](const Point3& x) { return double{seen(scene, x + Vec3(-0.5, 1.0, 0.1), x).g}; };
  const double sunny = 0.5 / pi * 100.0 * sun.y;
  // Two centimetres inside and outside of each edge of the patch.
  const double in = 0.02;
  for (const auto& [inside, outside] :
       {std::pair(on_floor(1.0 + in, 2.2), on_floor(1.0 - in, 2.2)),
        std::pair(on_floor(2.2 - in, 2.2), on_floor(2.2 + in, 2.2)),
        std::pair(on_floor(1.6, 1.5 + in), on_floor(1.6, 1.5 - in)),
        std::pair(on_floor(1.6, 2.9 - in), on_floor(1.6, 2.9 + in))}) {
    const double lit = light_at(inside), unlit = light_at(outside);
    // What else arrives hardly changes over four centimetres.
    EXPECT_NEAR(lit - unlit, sunny, 0.02 * sunny) << inside.x << ' ' << inside.z;
    EXPECT_LT(unlit, 0.15 * sunny);
  }
}

TEST(SkyPictures, SameBitsForAnyThreadCount) {
  Scene scene = room_with_window(diffuse(0.6));
  scene.background = sky_of(patterned);
  RenderSettings settings;
  settings.width = 48;
  settings.height = 36;
  settings.samples = 4;
  std::vector<Image> images;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(picture(lit_up(scene, pass_one(0.5, 64)),
                             look_at({0.5, 1.5, 4.5}, {4, 1.4, 1.5}, 1.2), settings));
  }
  EXPECT_EQ(images[0].pixels, images[1].pixels);
}

} // namespace
} // namespace meninas::test
