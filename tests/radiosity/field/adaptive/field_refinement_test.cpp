#include "radiosity/field/adaptive/field_refinement.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using Function = std::function<double(const Point3&)>;

bool everywhere(const Receiver&, double, std::uint32_t) { return true; }

FieldSampler sampled(const Function& f) {
  const SamplePoint sample = [f](const Receiver& receiver, double, std::uint32_t) -> PointSample {
    return {{Rgb(f(receiver.position)), Rgb(0.0)}};
  };
  return {sample, sample, everywhere};
}

/// Corners, counter-clockwise.
std::unique_ptr<LitScene> wall(const std::vector<Point3>& corners, double element_size) {
  Scene scene;
  add_polygon(scene, "wall", corners, diffuse(0.5));
  return lit(std::move(scene), {.element_size = element_size});
}
std::unique_ptr<LitScene> square_wall() {
  return wall({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0.2);
}

SampledField refined(const LitScene& l, const Function& f, RefinementSettings settings) {
  const std::vector<double> weight(element_count(l.mesh), 1.0);
  return refine_field(*l.light, sampled(f), weight, {}, settings);
}

/// Root mean square of what the field is off, on a fine grid over the square.
double true_error(const LitScene& l, const SampledField& field, const Function& f) {
  constexpr int n = 400;
  const Patch& patch = l.surfaces.patches[0];
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 uv((i + 0.5) / n, (j + 0.5) / n);
      const double value =
          double{value_in(field.mesh, field.total, locate(field.mesh, SideId{0}, uv)).x};
      sum += std::pow(value - f(point_at(patch, uv)), 2.0);
    }
  return std::sqrt(sum) / n;
}

/// Lit on one side of a slanted line.
double step(const Point3& x) { return x.x + 0.37 * x.y < 0.61 ? 1.0 : 0.0; }

TEST(FieldRefinement, WhatIsBilinearNeedsNoElements) {
  for (const auto& l : {square_wall(), wall({{0, 0, 0}, {1, 0, 0}, {0.3, 0.9, 0}}, 0.3)}) {
    const SampledField field =
        refined(*l, [](const Point3& x) { return 2.0 + x.x + 3.0 * x.y; }, {.error = 1e-3});
    // A vertex on the border gathers a fiftieth of an element further in,
    // which a linear function notices.
    EXPECT_LT(field.error, 0.05);
    const SampledField even = refined(*l, [](const Point3&) { return 0.7; }, {.error = 1e-6});
    EXPECT_EQ(element_count(even.mesh), element_count(l->mesh));
    EXPECT_LT(even.error, 1e-6);
    for (const auto& value : even.total)
      EXPECT_NEAR(value.x, 0.7F, 1e-6F);
  }
}

// Points tell the truth: the error a field says it has is the one it has.
TEST(FieldRefinement, ErrorsAreAsEstimatedAndWithinTheBound) {
  const auto l = square_wall();
  for (const double bound : {0.1, 0.05, 0.025}) {
    const SampledField field = refined(*l, step, {.error = bound, .max_levels = 8});
    EXPECT_LE(field.error, bound);
    const double error = true_error(*l, field, step);
    EXPECT_LT(error, 1.4 * bound); // five points see what they see
    EXPECT_NEAR(field.error, error, 0.4 * error);
  }
}

// A step costs J^2 h over its length, so that h falls with the square of the error, and the
// elements along it grow as h falls. Elements of one size would have to be as small everywhere.
TEST(FieldRefinement, ElementsLieAlongTheStep) {
  const auto l = square_wall();
  const SampledField field = refined(*l, step, {.error = 0.03, .max_levels = 8});
  const double smallest = *std::min_element(field.mesh.area.begin(), field.mesh.area.end());
  EXPECT_LT(3.0 * double(element_count(field.mesh)), 1.0 / smallest);
  for (std::size_t e = 0; e < element_count(field.mesh); ++e) {
    if (field.mesh.area[e] > 1.5 * smallest)
      continue;
    const Point3 centre = centre_of(field.mesh, static_cast<ElementId>(e));
    const double distance = std::abs(centre.x + 0.37 * centre.y - 0.61) / std::hypot(1.0, 0.37);
    EXPECT_LT(distance, 8.0 * std::sqrt(smallest)); // its neighbours' neighbours, no more
  }
}

// A strip of a few micrometres is at once as narrow as vertices can be told apart:
// what is asked for cannot be had, and what is had is said.
TEST(FieldRefinement, EndsWhereElementsMayNotBeDivided) {
  const auto l = wall({{0, 0, 0}, {1, 0, 0}, {1, 4e-6, 0}, {0, 4e-6, 0}}, 0.2);
  const SampledField field = refined(*l, step, {.error = 1e-3});
  for (std::uint32_t e = 0; e < element_count(field.mesh); ++e) {
    const MeshCell& cell = cell_of(field.mesh, ElementId{e});
    EXPECT_LT(cell.level, RefinementSettings{}.max_levels);
    EXPECT_TRUE(!is_divisible(field.mesh, l->surfaces, cell) || cell.level < 3);
  }
  EXPECT_GT(field.error, 1e-3);
}

TEST(FieldRefinement, WhatDoesNotShowIsLeftAlone) {
  const auto l = square_wall();
  const std::vector<double> black(element_count(l->mesh), 0.0);
  const SampledField field = refine_field(*l->light, sampled(step), black, {}, {.error = 1e-3});
  EXPECT_EQ(element_count(field.mesh), element_count(l->mesh));
}

/// 1 + x, off by up to `spread`, in every place by something else.
SamplePoint noisy(double spread) {
  return [spread](const Receiver& receiver, double, std::uint32_t seed) -> PointSample {
    const double off = spread * (0x1p-31 * hash(seed, 5, 6) - 1.0);
    return {{Rgb(1.0 + receiver.position.x + off), Rgb(0.0)}};
  };
}

// Noise grows no smaller by division. Samples that tell their variance are divided for nothing,
// those that keep it to themselves for ever.
TEST(FieldRefinement, NoiseIsKnownAndNoReasonToDivide) {
  const auto l = square_wall();
  constexpr double spread = 0.1;
  const SamplePoint whole = noisy(spread), half = noisy(spread * std::numbers::sqrt2);
  const SamplePoint told = [half](const Receiver& receiver, double size, std::uint32_t seed) {
    const double a = half(receiver, size, seed).light.total.g,
                 b = half(receiver, size, ~seed).light.total.g;
    return PointSample{{Rgb(0.5 * (a + b)), Rgb(0.0)}, Cover::open, 0.25 * (a - b) * (a - b)};
  };
  const std::vector<double> weight(element_count(l->mesh), 1.0);
  const RefinementSettings settings{.error = 0.01, .max_levels = 4};
  const SampledField field =
                         refine_field(*l->light, {whole, told, everywhere}, weight, {}, settings),
                     blind =
                         refine_field(*l->light, {whole, whole, everywhere}, weight, {}, settings);
  EXPECT_LT(element_count(field.mesh), 2 * element_count(l->mesh));
  EXPECT_GT(element_count(blind.mesh), 100 * element_count(l->mesh));
  // Even over [-s, s]: the mean square is s^2 / 3;
  // light is 1.5 on average, its root mean square 1.53.
  EXPECT_NEAR(field.noise, spread / std::sqrt(3.0) / 1.53, 0.005);
}

TEST(FieldRefinement, LimitsHold) {
  const auto l = square_wall();
  const SampledField few = refined(*l, step, {.error = 1e-6, .max_elements = 300});
  EXPECT_LE(element_count(few.mesh), 300U);
  EXPECT_GT(few.error, 1e-6); // and it says so
  const SampledField flat = refined(*l, step, {.error = 1e-6, .max_levels = 2});
  for (std::size_t e = 0; e < element_count(flat.mesh); ++e)
    EXPECT_LE(cell_of(flat.mesh, static_cast<ElementId>(e)).level, 2);
}

// A lit disc too small for the points of a root cell is found where an outline is known to pass.
TEST(FieldRefinement, OutlinesAreLookedAtMoreClosely) {
  const auto l = wall({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0);
  const auto strip = [](const Point3& x) { return std::abs(x.x - 0.318) < 0.02 ? 1.0 : 0.0; };
  MirrorOutlines outlines;
  for (int k = 0; k <= 64; ++k)
    outlines.push_back({SideId{0}, Vec2(0.318, k / 64.0)});
  const std::vector<double> weight{1.0};
  const RefinementSettings settings{.error = 0.08, .points = 0, .max_levels = 7};
  const SampledField blind = refine_field(*l->light, sampled(strip), weight, {}, settings),
                     seeing = refine_field(*l->light, sampled(strip), weight, outlines, settings);
  EXPECT_LT(true_error(*l, seeing, strip), 0.5 * true_error(*l, blind, strip));
}

TEST(FieldRefinement, TheSameBitsForAnyThreads) {
  const auto l = lit(half_room(), {.target_elements = 200});
  const Function f = [](const Point3& x) { return std::sin(7.0 * x.x) * x.y + step(x); };
  const SampledField all = refined(*l, f, {.error = 0.05});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SampledField alone = refined(*l, f, {.error = 0.05});
  EXPECT_EQ(all.total, alone.total);
  EXPECT_EQ(division_of(all.mesh), division_of(alone.mesh));
  EXPECT_EQ(all.error, alone.error);
}

} // namespace
} // namespace meninas::test
