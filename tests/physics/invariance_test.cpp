#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

struct Solved {
  std::unique_ptr<LitScene> lit;
  RadiositySolution solution;
};

PassOneSettings settings_of(double element_size, int rays) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  return settings;
}

Solved solved(const Scene& scene, const PassOneSettings& settings) {
  Solved result{lit(scene, settings.mesh), {}};
  result.solution = solve_pass_one(result.lit->light, settings);
  return result;
}

TEST(Determinism, SameBitsForAnyThreadCountAndRun) {
  for (const Scene& scene : {half_room_with_small_mirror(), facing_mirrors(Rgb(0.95, 0.9, 0.8))}) {
    const PassOneSettings settings = settings_of(0.1, 128);
    std::vector<Solved> runs;
    for (const std::size_t threads : {1, 2, 2, 4}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      runs.push_back(solved(scene, settings));
    }
    for (const auto& run : runs) {
      EXPECT_EQ(run.solution.radiosity, runs[0].solution.radiosity);
      EXPECT_EQ(run.solution.irradiance, runs[0].solution.irradiance);
      EXPECT_EQ(run.solution.field.irradiance, runs[0].solution.field.irradiance);
      EXPECT_EQ(run.solution.solver.residuals, runs[0].solution.solver.residuals);
      EXPECT_EQ(run.solution.form_factor_rays, runs[0].solution.form_factor_rays);
      EXPECT_EQ(run.solution.shadow_rays, runs[0].solution.shadow_rays);
    }
  }
}

TEST(Determinism, AnotherSeedIsAnotherSample) {
  PassOneSettings settings = settings_of(0.25, 64);
  const auto first = solved(half_room(), settings);
  settings.form_factors.seed = 1;
  EXPECT_NE(solved(half_room(), settings).solution.irradiance, first.solution.irradiance);
}

/// Element by element, relative to the brightest channel of the element.
struct Change {
  double rms = 0.0, worst = 0.0;
};

Change change(const std::vector<Rgb>& before, const std::vector<Rgb>& after) {
  Change c;
  EXPECT_EQ(before.size(), after.size());
  for (std::size_t e = 0; e < std::min(before.size(), after.size()); ++e) {
    const double size = std::max({before[e].r, before[e].g, before[e].b});
    if (size == 0.0)
      continue;
    const Rgb error = (after[e] - before[e]) / size;
    c.worst = std::max({c.worst, std::abs(error.r), std::abs(error.g), std::abs(error.b)});
    c.rms += glm::dot(error, error) / (3.0 * double(before.size()));
  }
  c.rms = std::sqrt(c.rms);
  return c;
}

// Scale, place and orientation change nothing but roundings: samples are counted from the surfaces.
// A rounding may move a ray that grazes an edge, or lands at the border of an element,
// to the other side: one of 512 gather rays, which alone is less than 1 %.
TEST(Invariance, ScalePlaceAndOrientation) {
  const Scene scene = half_room_with_small_mirror();
  const auto before = solved(scene, settings_of(0.125, 512));
  const glm::dmat3 straight(1.0),
      turned(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(Vec3(0.3, 1.0, -0.5))));
  struct Move {
    glm::dmat3 rotation;
    double scale;
    Vec3 offset;
  };
  for (const Move& move : {Move{straight, 1e-4, Vec3(0.0)}, Move{straight, 1e4, Vec3(0.0)},
                           Move{straight, 1.0, {2e4, -1e4, 3e4}}, Move{turned, 1.0, Vec3(0.0)},
                           Move{turned, 1e-4, {3.0, -1.0, 2.0}}}) {
    const auto after = solved(transformed(scene, move.rotation, move.scale, move.offset),
                              settings_of(0.125 * move.scale, 512));
    const Change c = change(before.solution.irradiance, after.solution.irradiance);
    EXPECT_LT(c.worst, 0.01) << move.scale;
    EXPECT_LT(c.rms, 1e-4) << move.scale;
    // The field between the elements likewise, compared vertex by vertex. To vertices beyond a
    // contact a line is followed by up to twice its length, which carries five times the errors.
    ASSERT_EQ(before.solution.field.irradiance.size(), after.solution.field.irradiance.size());
    for (std::size_t v = 0; v < after.solution.field.irradiance.size(); ++v)
      EXPECT_NEAR(after.solution.field.irradiance[v].g, before.solution.field.irradiance[v].g,
                  (is_at_contact(before.lit->mesh, v) ? 0.05 : 0.01) *
                          before.solution.field.irradiance[v].g +
                      1e-6);
  }
}

TEST(Extremes, EmissionFrom1em12To1e12) {
  const auto emitting = [](double factor) {
    Scene scene = half_room();
    for (auto& material : scene.materials)
      material.emission *= factor;
    return solved(scene, settings_of(0.25, 64));
  };
  const auto before = emitting(1.0);
  for (const double factor : {1e-12, 1e12}) {
    auto after = emitting(factor);
    EXPECT_TRUE(after.solution.solver.converged);
    for (auto& h : after.solution.irradiance)
      h /= factor;
    EXPECT_LT(change(before.solution.irradiance, after.solution.irradiance).worst, 1e-9);
    for (std::size_t v = 0; v < after.solution.field.irradiance.size(); ++v)
      EXPECT_NEAR(after.solution.field.irradiance[v].r / factor,
                  before.solution.field.irradiance[v].r,
                  1e-4 * before.solution.field.irradiance[v].r + 1e-9);
  }
}

TEST(Extremes, NothingEmits) {
  Scene scene = half_room();
  for (auto& material : scene.materials)
    material.emission = Rgb(0.0);
  const auto dark = solved(scene, settings_of(0.5, 16));
  EXPECT_TRUE(dark.solution.solver.converged);
  for (const auto& h : dark.solution.field.irradiance)
    EXPECT_EQ(h, glm::vec3(0.0F));
  EXPECT_EQ(dark.solution.energy.imbalance, 0.0);
}

TEST(Extremes, OnlyMirrorsAndNothingAtAll) {
  const auto mirrors =
      solved(furnace(0.5, {true, true, true, true, true, true}), settings_of(0.5, 16));
  EXPECT_TRUE(mirrors.solution.radiosity.empty());
  const auto nothing = solved({}, settings_of(0.5, 16));
  EXPECT_TRUE(nothing.solution.radiosity.empty());
}

TEST(Extremes, EverythingIsFinite) {
  Scene scene = half_room_with_small_mirror();
  add_polygon(scene, "sliver", {{0.1, 0.0, 0.1}, {0.1, 2.4, 0.1}, {0.1 + 1e-7, 2.4, 0.1}},
              double_sided(diffuse(0.9)));
  add_polygon(scene, "crumb", {{1.5, 0.0, 2.0}, {1.5 + 1e-5, 0.0, 2.0}, {1.5, 1e-5, 2.0}},
              diffuse(0.9, 1e6));
  const auto result = solved(scene, settings_of(0.2, 64));
  for (const auto& b : result.solution.radiosity)
    EXPECT_TRUE(std::isfinite(b.r) && b.r >= 0.0);
  for (const auto& h : result.solution.field.irradiance)
    EXPECT_TRUE(std::isfinite(h.r) && h.r >= 0.0F);
}

} // namespace
} // namespace meninas::test
