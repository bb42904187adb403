// The sky in the reference: chosen and met, also small suns and by way of mirrors; and the two passes
// beside it in a room with a window.
#include "raytrace/two_pass.h"
#include "tests/reference/tracing.h"
#include "tests/support/skies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using reference::LightSearch;
constexpr double pi = std::numbers::pi;

TEST(ReferenceSkies, OpenGroundReflectsTheIntegralOfItsHemisphere) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, diffuse(0.6));
  scene.background = sky_of([](const Direction& d) { return Rgb(std::max(0.0, d.y), 1.0, d.x > 0.0 ? 1.0 : 0.0); }, 512);
  expect_radiance(radiance_seen(scene, {1, 1, 0}, {0, 0, 0}, 512),
                  0.6 / pi * Rgb(2.0 * pi / 3.0, pi, 0.5 * pi));
}

TEST(ReferenceSkies, SmallSunsConverge) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, diffuse(0.6));
  const Direction sun = glm::normalize(Vec3(0.4, 0.8, 0.2));
  scene.background = sky_of([&](const Direction& d) { return Rgb(glm::dot(d, sun) > std::cos(0.01) ? 2e4 : 1.0); }, 1024);
  // By its own integral: the sun's rim is that of texels.
  const RadianceMap& map = *scene.background.map;
  double irradiance = 0.0;
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      const double up = direction_at(map, (i + 0.5) / map.width, (j + 0.5) / map.height).y;
      irradiance += texel_solid_angle(map, j) * std::max(0.0, up) *
                    double{map.texels[static_cast<std::size_t>(j * map.width + i)].g};
    }
  expect_radiance(radiance_seen(scene, {1, 1, 0}, {0, 0, 0}, 256), Rgb(0.6 / pi * irradiance));
}

MeanRadiance by(LightSearch search, const Scene& scene, int samples) {
  auto settings = tracing(12, 12, samples);
  settings.search = search;
  return mean_radiance(traced_picture(scene, look_at({0.6, 1.3, 4.4}, {2.5, 0.6, 2.0}, 1.0), settings));
}

void expect_same(const MeanRadiance& a, const MeanRadiance& b) {
  for (int band = 0; band < 3; ++band) {
    const double error = std::hypot(a.error[band], b.error[band]);
    EXPECT_LT(error, 0.03 * a.mean[band]) << "too noisy to tell";
    EXPECT_NEAR(a.mean[band], b.mean[band], 4.0 * error) << band;
  }
}

TEST(ReferenceSkies, ChoosingMeetingAndBothAgreeAlsoByWayOfAMirror) {
  Scene scene = room_with_window(diffuse(0.6));
  scene.materials[0] = mirror(0.8);
  scene.background = sky_of([](const Direction& d) { return Rgb(1.0 + 3.0 * std::max(0.0, d.y), 1.0 + d.z, d.x > 0.9 ? 8.0 : 1.0); });
  const MeanRadiance both = by(LightSearch::both, scene, 512);
  expect_same(both, by(LightSearch::choosing, scene, 1024));
  expect_same(both, by(LightSearch::meeting, scene, 1024));
}

Rgb seen_by_two_passes(const RadiositySolution& solution, const Point3& eye, const Point3& target) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 64;
  settings.diffuse.term = DiffuseTerm::direct;
  return render(solution.field, look_at(eye, target, 1e-4), settings).image.pixels[0];
}

// A window under a sky that is brighter above and bluer to one side, in a room with a mirror: radiances
// agree within four standard errors and the field's error of a hundredth.
TEST(ReferenceSkies, TheTwoPassesAgreeInARoomWithAWindow) {
  Scene scene = room_with_window(diffuse(Rgb(0.7, 0.6, 0.5)));
  scene.materials[3] = mirror(0.85);
  scene.background = sky_of([](const Direction& d) {
    return Rgb(1.0 + 3.0 * std::max(0.0, d.y), 2.0 + std::max(0.0, d.y), 2.0 + d.z);
  });
  PassOneSettings settings;
  settings.mesh.element_size = 0.2;
  settings.form_factors.rays = settings.interpolation.rays = 512;
  const auto prepared = prepare_scene(scene, settings);
  ASSERT_EQ(prepared->light()->portals.size(), 1U);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
  struct Sight {
    const char* what;
    Point3 eye, target;
  };
  for (const Sight& sight : {Sight{"the floor before the window", {1.0, 1.5, 2.5}, {2.6, 0.0, 2.2}},
                             {"the floor in a corner", {2.0, 1.5, 2.5}, {0.5, 0.0, 0.6}},
                             {"the wall opposite", {2.0, 1.5, 2.5}, {0.0, 1.2, 1.8}},
                             {"the window's mirror image", {2.0, 1.5, 3.5}, {3.0, 1.6, 0.0}}}) {
    SCOPED_TRACE(sight.what);
    const Rgb found = seen_by_two_passes(solution, sight.eye, sight.target);
    const MeanRadiance truth = radiance_seen(scene, sight.eye, sight.target, 4096);
    for (int band = 0; band < 3; ++band) {
      EXPECT_LT(truth.error[band], 0.02 * truth.mean[band]);
      EXPECT_NEAR(found[band], truth.mean[band],
                  4.0 * truth.error[band] + 0.01 * truth.mean[band]);
    }
  }
}

} // namespace
} // namespace meninas::test
