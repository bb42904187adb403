// Which parameters are turned next, from a run with made-up figures.
#include "runs/steering/steering_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace meninas {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double for_ever = std::numeric_limits<double>::infinity();

/// A run that is wrong by these parts.
MeasuredRun run_with(double mesh, double mesh_direct, double form_factors, double pixels) {
  MeasuredRun run;
  run.error.mesh = mesh;
  run.error.mesh_direct = mesh_direct;
  run.error.form_factors = form_factors;
  run.error.pixels = pixels;
  run.error.total = std::hypot(mesh, form_factors, pixels);
  run.direct_cost = 1e-6;
  run.pass_one_cost = 0.2;
  run.pass_two_cost = 0.02;
  run.estimate_cost = 0.01;
  run.pixels = 65'536.0;
  return run;
}

TEST(Forecast, OfTheSameParametersIsTheRunItself) {
  const MeasuredRun run = run_with(0.03, 0.02, 0.02, 0.04);
  const Forecast same = forecast(run, run.parameters);
  EXPECT_NEAR(same.error, run.error.total, 1e-12);
  EXPECT_NEAR(same.cost, 0.03, 1e-12) << "pass one is there";
}

TEST(Forecast, OfFindingOutIsWhatItsPixelsAndTheirSamplesTake) {
  MeasuredRun run = run_with(0.03, 0.02, 0.02, 0.04);
  run.pass_one_cost = run.pass_two_cost = 0.0;
  run.estimate_cost = 0.03;
  const auto seconds = [&](double elements, int rays, int samples) {
    const Forecast then = forecast(run, {elements, rays, samples, run.parameters.term});
    EXPECT_EQ(then.estimate, then.cost) << "nothing else costs anything";
    return then.cost;
  };
  EXPECT_NEAR(seconds(600, 64, 16), 0.03, 1e-12) << "pixels of 4 are four times as many";
  EXPECT_NEAR(seconds(600, 64, 64), 0.02 + 0.01 * (16 + 16 + 64) / 3.0 / 16.0, 1e-12);
  EXPECT_NEAR(seconds(600, 64, 1024), 0.02 + 0.01 * (16 + 64 + 256 + 1024) / 4.0 / 16.0, 1e-12);
  EXPECT_NEAR(seconds(600, 256, 4), 0.02 * (128 + 256) / (128 + 64) + 0.01, 1e-12);
  EXPECT_NEAR(seconds(2400, 64, 4), 0.03, 1e-12) << "64 pixels are the fewest";
  EXPECT_NEAR(seconds(4800, 64, 4), 0.03 * 96 / 64, 1e-12) << "two in a hundred";
  EXPECT_NEAR(seconds(50'000, 64, 4), 0.03 * 512 / 64, 1e-12) << "512 are the most";
}

TEST(Forecast, DoesNotTakeWhatIsUnknownForNothing) {
  // Nearly all of the mesh's error is edges, as far as these are known:
  // exact ones may leave a tenth of it.
  const MeasuredRun run = run_with(0.09, 0.09, 0.0, 0.0);
  Parameters direct = run.parameters;
  direct.term = DiffuseTerm::direct;
  EXPECT_NEAR(forecast(run, direct).error, 0.009, 1e-12);
  EXPECT_NEAR(forecast(run_with(0.09, 0.05, 0.0, 0.0), direct).error, std::sqrt(0.0081 - 0.0025),
              1e-12);
}

// The field of the view stays where only samples change: 16 to 64 of them in every pixel cost
// the camera rays of 64, not the vertices, which take as much as 200.
TEST(Forecast, OfMoreSamplesLeavesTheFieldOfTheView) {
  MeasuredRun run = run_with(0.001, 0.0, 0.001, 0.1);
  run.parameters.term = DiffuseTerm::direct;
  run.parameters.samples = 16;
  run.samples_a_pixel = 16.0;
  run.pass_two_cost = 216.0;
  run.estimate_cost = 0.0;
  Parameters more = run.parameters;
  more.samples = 64;
  EXPECT_NEAR(forecast(run, more).cost, 64.0, 1e-9);
  more.rays *= 2;
  EXPECT_GT(forecast(run, more).cost, 264.0);
}

TEST(NextRun, TurnsTheParameterOfTheLargestPart) {
  const NextRun rays = next_run(run_with(0.001, 0.0, 0.1, 0.001), {}, 0.05, for_ever);
  EXPECT_GT(rays.parameters.rays, Parameters{}.rays);
  EXPECT_EQ(rays.parameters.samples, Parameters{}.samples);
  EXPECT_THAT(rays.why, HasSubstr("form factors 10 %"));
  const NextRun samples = next_run(run_with(0.001, 0.0, 0.001, 0.1), {}, 0.05, for_ever);
  EXPECT_GT(samples.parameters.samples, Parameters{}.samples);
  EXPECT_EQ(samples.parameters.rays, Parameters{}.rays);
  const NextRun edges = next_run(run_with(0.3, 0.3, 0.001, 0.001), {}, 0.05, for_ever);
  EXPECT_EQ(edges.parameters.term, DiffuseTerm::direct) << "thousands of elements would do no better";
  const NextRun smooth = next_run(run_with(0.1, 0.0, 0.001, 0.001), {}, 0.05, for_ever);
  EXPECT_GT(smooth.parameters.elements, Parameters{}.elements);
}

// 64 samples were next to nothing by interpolation;
// with light computed at every hit fewer are enough for what is wanted.
TEST(NextRun, TakesFewerCameraRaysWhereEachComputesLight) {
  MeasuredRun run = run_with(0.026, 0.026, 0.001, 0.001);
  run.parameters.samples = 64;
  run.samples_a_pixel = 64.0;
  run.parameters.elements = 100'000.0;
  run.pass_one_cost = 20.0;
  const NextRun next = next_run(run, {}, 0.017, for_ever);
  EXPECT_EQ(next.parameters.term, DiffuseTerm::direct);
  EXPECT_LT(next.parameters.samples, 64);
  EXPECT_LE(next.forecast.error, 0.017);
  const NextRun kept = next_run(run, {.samples = false}, 0.017, for_ever);
  EXPECT_EQ(kept.parameters.samples, 64);
}

// Camera rays cost next to nothing: as many as there can be must not keep direct light,
// whose vertices take 3.9 s, out of the time.
TEST(NextRun, ComputesDirectLightWhereTheTimeIsShort) {
  MeasuredRun run = run_with(0.089, 0.089, 0.01, 0.017);
  run.direct_cost = 2e-4;
  run.uncertain = {0.2, 0.03, 0.005, 0.001};
  const NextRun next = next_run(run, {}, 0.014, 6.0);
  EXPECT_EQ(next.parameters.term, DiffuseTerm::direct);
  EXPECT_LE(next.forecast.cost, 6.0);
}

TEST(NextRun, GoesBackWithWhatHardlyMattersWhereTheTimeIsShort) {
  // Edges that no time is left to compute:
  // a thousand camera rays would take off next to nothing else.
  MeasuredRun run = run_with(0.2, 0.2, 0.001, 0.002);
  run.direct_cost = 1.0;
  const NextRun next = next_run(run, {}, 0.014, 1.0);
  EXPECT_EQ(next.parameters.term, DiffuseTerm::interpolated);
  EXPECT_GT(next.parameters.elements, run.parameters.elements);
  EXPECT_EQ(next.parameters.samples, run.parameters.samples);
  EXPECT_EQ(next.parameters.rays, run.parameters.rays);
}

TEST(NextRun, ForetellsWhatWasWanted) {
  for (const double wanted : {0.05, 0.02, 0.015}) {
    const NextRun next = next_run(run_with(0.08, 0.06, 0.05, 0.06), {}, wanted, for_ever);
    EXPECT_LE(next.forecast.error, wanted);
    EXPECT_GT(next.forecast.error, 0.3 * wanted) << "and not far more than that";
  }
}

TEST(NextRun, DividesNoFurtherAtOnceThanIsKnown) {
  const NextRun next = next_run(run_with(0.2, 0.0, 0.001, 0.001), {}, 0.001, for_ever);
  EXPECT_LE(next.parameters.elements, 16.0 * Parameters{}.elements);
}

TEST(NextRun, GathersWhereMeshesDoNotHelp) {
  // 8 % that four times the elements have taken a tenth of the square off: 0.9 = 4^-0.076.
  MeasuredRun coarse = run_with(0.08, 0.0, 0.005, 0.001);
  coarse.divided = 700.0;
  MeasuredRun fine = coarse;
  fine.parameters.elements *= 4.0;
  fine.divided *= 4.0;
  fine.error.mesh *= std::sqrt(0.9);
  EXPECT_NEAR(measured_mesh_exponent(coarse, fine), 0.076, 0.001);
  MeasuredRun edges = coarse;
  edges.error.mesh_direct = 0.079;
  EXPECT_EQ(measured_mesh_exponent(edges, fine), 1.0) << "what is left of edges is not known";
  fine.gather_cost = 1e-5;
  const NextRun divided = next_run(fine, {}, 0.02, for_ever);
  EXPECT_EQ(divided.parameters.term, DiffuseTerm::interpolated) << "by what meshes do as a rule";
  fine.mesh_exponent = measured_mesh_exponent(coarse, fine);
  const NextRun gathered = next_run(fine, {}, 0.02, for_ever);
  EXPECT_EQ(gathered.parameters.term, DiffuseTerm::gather);
  EXPECT_LE(gathered.forecast.error, 0.02);
  EXPECT_THAT(gathered.why, HasSubstr("gathered at every hit"));
}

// Asked for four times as many a scene of small surfaces has a tenth more:
// its error is what it was, and that tells nothing.
TEST(NextRun, DoesNotTakeWhatWasNotDividedForWhatDivisionDoesNotHelp) {
  MeasuredRun coarse = run_with(0.08, 0.0, 0.005, 0.001);
  coarse.divided = 1000.0;
  MeasuredRun fine = coarse;
  fine.parameters.elements *= 4.0;
  fine.divided = 1100.0;
  EXPECT_EQ(measured_mesh_exponent(coarse, fine), coarse.mesh_exponent);
  fine.divided = 4000.0;
  EXPECT_EQ(measured_mesh_exponent(coarse, fine), 0.0);
}

// Light that is gathered everywhere may come from elements that are wrong: finer ones may not be.
TEST(NextRun, DividesWhatIsGatheredFrom) {
  MeasuredRun run = run_with(0.15, 0.0, 0.0, 0.005);
  run.parameters.term = DiffuseTerm::gather;
  const NextRun next = next_run(run, {}, 0.05, for_ever);
  EXPECT_GE(next.parameters.elements, 9.0 * run.parameters.elements) << "the square falls with their number";
  EXPECT_EQ(next.parameters.term, DiffuseTerm::gather);
  EXPECT_THAT(next.why, HasSubstr("mesh 15 %"));
}

TEST(NextRun, SamplesCostWhatTheUncertainPixelsTake) {
  // One pixel in twenty would take sixteen samples instead of four,
  // and one in fifty 64 instead of those.
  MeasuredRun run = run_with(0.001, 0.0, 0.001, 0.1);
  run.uncertain = {0.05, 0.02, 0.0, 0.0};
  Parameters more = run.parameters;
  more.samples = 16;
  run.estimate_cost = 0.0;
  const double picture = run.pass_two_cost;
  EXPECT_NEAR(forecast(run, more).cost, picture * (4.0 + 0.05 * 12.0) / 4.0, 1e-9);
  more.samples = 64;
  const Forecast all = forecast(run, more);
  EXPECT_NEAR(all.cost, picture * (4.0 + 0.05 * 12.0 + 0.02 * 48.0) / 4.0, 1e-9);
  more.samples = 256;
  EXPECT_EQ(forecast(run, more).error, all.error) << "no pixel would take them";
}

TEST(NextRun, TurnsNoParameterFurtherThanNeeded) {
  const MeasuredRun run = run_with(0.055, 0.048, 0.02, 0.02);
  constexpr double wanted = 0.017;
  const NextRun next = next_run(run, {}, wanted, for_ever);
  ASSERT_LE(next.forecast.error, wanted);
  std::vector<Parameters> less(3, next.parameters);
  less[0].elements /= 2.0;
  less[1].rays /= 2;
  less[2].samples /= 4;
  for (const Parameters& parameters : less)
    if (parameters.elements >= run.parameters.elements && parameters.rays >= run.parameters.rays &&
        parameters.samples >= run.parameters.samples) {
      EXPECT_GT(forecast(run, parameters).error, wanted);
    }
}

TEST(NextRun, StaysWithinTheTime) {
  for (const double seconds : {0.1, 0.5, 4.0}) {
    const NextRun next = next_run(run_with(0.08, 0.06, 0.05, 0.06), {}, 0.0, seconds);
    EXPECT_LE(next.forecast.cost, seconds);
  }
  const MeasuredRun run = run_with(0.08, 0.06, 0.05, 0.06);
  EXPECT_EQ(next_run(run, {}, 0.0, 1e-3).parameters, run.parameters) << "nothing fits";
}

TEST(NextRun, LeavesParametersThatWereSet) {
  const NextRun next =
      next_run(run_with(0.1, 0.05, 0.1, 0.1),
               {.elements = false, .rays = false, .samples = false, .term = false}, 0.01, for_ever);
  EXPECT_EQ(next.parameters, Parameters{});
  EXPECT_THAT(next.why, IsEmpty());
}

// More elements, rays and samples at once: the mesh is said to be worse, the rest is better.
TEST(WorthTurning, IsWhatHelpedItsOwnPartOfTheError) {
  const MeasuredRun before = run_with(0.034, 0.0, 0.031, 0.034);
  MeasuredRun turned = run_with(0.089, 0.0, 0.008, 0.003);
  turned.parameters.elements *= 4.0;
  turned.parameters.rays *= 8;
  turned.parameters.samples *= 16;
  const FreeParameters free = worth_changing({}, before, turned);
  EXPECT_FALSE(free.elements);
  EXPECT_TRUE(free.rays && free.samples && free.term);
  turned.error.form_factors = 0.04;
  EXPECT_FALSE(worth_changing({}, before, turned).rays);
  EXPECT_FALSE(worth_changing({.samples = false}, before, turned).samples) << "a user has set it";
  turned.parameters = before.parameters;
  turned.parameters.term = DiffuseTerm::gather;
  const FreeParameters gathered = worth_changing({}, before, turned);
  EXPECT_TRUE(gathered.elements && gathered.rays && gathered.samples);
  EXPECT_FALSE(gathered.term);
}

} // namespace
} // namespace meninas
