#include "tests/radiosity/solvers/radiosity_systems.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

// B1 = 1 + 1/2 * 1/2 B2, B2 = 1/4 * 1 B1:  B1 = 1 / (1 - 1/16) = 16/15, B2 = 4/15.
TEST(Solve, TwoByTwo) {
  Eigen::MatrixXd m(2, 2);
  m << 0.0, 0.5, 1.0, 0.0;
  const SolverResult result =
      solve(transport_of({m}), {Rgb(1.0), Rgb(0.0)}, {Rgb(0.5), Rgb(0.25)}, {.tolerance = 1e-12});
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.radiosity[0].r, 16.0 / 15.0, 1e-11);
  EXPECT_NEAR(result.radiosity[1].b, 4.0 / 15.0, 1e-11);
}

TEST(Solve, TheBoundBoundsTheErrorAndIsNotIdle) {
  Random random(2);
  for (int k = 0; k < 60; ++k) {
    const System system =
        random_system(random, 3 + k, k % 2 == 0 ? 1 : 3, random.between(0.2, 0.999));
    const double tolerance = std::pow(10.0, random.between(-6, -1));
    const SolverResult result =
        solve(system.transport, system.source, system.reflectance, {.tolerance = tolerance});
    const double error = true_error(exact_solution(system), result.radiosity);
    EXPECT_LE(error, result.error_bound * (1.0 + 1e-9) + 1e-14);
    EXPECT_LE(result.error_bound, tolerance);
    // Rows that all see alike make the bound nearly sharp: an order of magnitude is ample.
    EXPECT_GE(10.0 * error, 0.01 * result.error_bound);
    EXPECT_EQ(result.residuals.size(), static_cast<std::size_t>(result.iterations) + 1);
    EXPECT_EQ(result.residuals.back(), result.residual);
  }
}

/// The mean over area of what is left, relative to what is there, of the worst channel.
double share_left(const std::vector<Rgb>& exact, const std::vector<Rgb>& x,
                  const std::vector<double>& area) {
  Rgb sum(0.0);
  double whole = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    sum += area[i] * glm::abs(exact[i] - x[i]) / x[i];
    whole += area[i];
  }
  return std::max({sum.r, sum.g, sum.b}) / whole;
}

// Sweeps leave a residual of one sign, of which only the bounces after the fourth are not summed.
// A Krylov method leaves one of both signs, whose bounces cancel: there it bounds.
TEST(Solve, TheErrorInTheMeanIsWhatIsLeft) {
  Random random(21);
  for (int k = 0; k < 40; ++k) {
    const auto [system, area] = reciprocal_system(random, 10 + 2 * k, 2.0, 1.0);
    const std::vector<Rgb> exact = exact_solution(system);
    const double tolerance = std::pow(10.0, random.between(-5, -2));
    const auto solved_by = [&](SolverMethod method) {
      return solve(system.transport, system.source, system.reflectance,
                   {.method = method, .tolerance = tolerance},
                   {.shooters = {}, .watch = {}, .progress = {}, .areas = area});
    };
    const SolverResult sweeps = solved_by(SolverMethod::jacobi), steps = solved_by(SolverMethod::bicgstab);
    const double left = share_left(exact, sweeps.radiosity, area);
    EXPECT_NEAR(sweeps.relative_error, left, 0.1 * left + 1e-14) << k;
    EXPECT_GE(1.1 * steps.relative_error + 1e-14, share_left(exact, steps.radiosity, area)) << k;
  }
}

// Two rooms that know nothing of each other, one a million times as bright, stop where each of them is solved.
TEST(Solve, ABrightRoomDoesNotStandForADarkOne) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(4, 4);
  m(0, 1) = m(1, 0) = m(2, 3) = m(3, 2) = 1.0;
  const std::vector<Rgb> source{Rgb(1e6), Rgb(0.0), Rgb(1.0), Rgb(0.0)},
      reflectance{Rgb(0.5), Rgb(0.5), Rgb(0.9), Rgb(0.9)};
  const std::vector<double> areas(4, 1.0);
  for (const auto method : {SolverMethod::bicgstab, SolverMethod::gauss_seidel, SolverMethod::jacobi}) {
    const SolverResult result =
        solve(transport_of({m}), source, reflectance, {.method = method},
              {.shooters = {}, .watch = {}, .progress = {}, .areas = areas});
    EXPECT_TRUE(result.converged) << name_of(method);
    EXPECT_EQ(result.residuals.size(), static_cast<std::size_t>(result.iterations) + 1);
    // B = S / (1 - rho^2), and rho B on the wall across; ten tolerances.
    const double lit = 1.0 / (1.0 - 0.9 * 0.9);
    EXPECT_NEAR(result.radiosity[2].r, lit, 1e-3 * lit) << name_of(method);
    EXPECT_NEAR(result.radiosity[3].r, 0.9 * lit, 1e-3 * 0.9 * lit) << name_of(method);
    EXPECT_LT(result.relative_error, 1e-3) << name_of(method);
  }
}

TEST(Solve, BandsDoNotMix) {
  Random random(3);
  System system = random_system(random, 20, 3, 0.8);
  for (auto& source : system.source)
    source.g = 0.0;
  for (auto& reflectance : system.reflectance)
    reflectance.b = 0.0;
  const SolverResult result = solve(system.transport, system.source, system.reflectance);
  EXPECT_TRUE(result.converged);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(result.radiosity[i].g, 0.0);
    EXPECT_EQ(result.radiosity[i].b, system.source[i].b);
    EXPECT_GT(result.radiosity[i].r, system.source[i].r);
  }
}

TEST(Solve, AClosedRoomOfReflectanceOneIsNotSolved) {
  Random random(4);
  System system = random_system(random, 50, 1, 1.0);
  for (auto& reflectance : system.reflectance)
    reflectance = Rgb(1.0);
  const SolverResult result = solve(system.transport, system.source, system.reflectance);
  EXPECT_FALSE(result.converged);
  EXPECT_LE(result.iterations, 200);
  for (const auto& b : result.radiosity)
    EXPECT_TRUE(std::isfinite(b.r));
}

TEST(Solve, ReflectanceOneInAnOpenRoomIsSolved) {
  Eigen::MatrixXd m(2, 2);
  m << 0.0, 0.5, 0.5, 0.0;
  const SolverResult result =
      solve(transport_of({m}), {Rgb(1.0), Rgb(0.0)}, {Rgb(1.0), Rgb(1.0)}, {.tolerance = 1e-10});
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.radiosity[0].r, 4.0 / 3.0, 1e-9);
}

TEST(Solve, NothingInNothingOut) {
  Random random(5);
  System system = random_system(random, 30, 1, 0.9, 0.0);
  const SolverResult result = solve(system.transport, system.source, system.reflectance);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.error_bound, 0.0);
  for (const auto& b : result.radiosity)
    EXPECT_EQ(b, Rgb(0.0));
  EXPECT_TRUE(solve(transport_of({Eigen::MatrixXd(0, 0)}), {}, {}).converged);
}

TEST(Solve, AnyEmissionGivesTheSamePicture) {
  Random at_one(6);
  const System unit = random_system(at_one, 40, 1, 0.9);
  const SolverResult expected = solve(unit.transport, unit.source, unit.reflectance);
  for (const double emission : {1e-12, 1e-6, 1e6, 1e12}) {
    Random again(6);
    const System system = random_system(again, 40, 1, 0.9, emission);
    const SolverResult result = solve(system.transport, system.source, system.reflectance);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.iterations, expected.iterations);
    for (std::size_t i = 0; i < 40; ++i)
      EXPECT_NEAR(result.radiosity[i].r / emission, expected.radiosity[i].r,
                  1e-12 * expected.radiosity[i].r);
  }
}

TEST(Solve, IterationLimitIsReported) {
  Random random(7);
  const System system = random_system(random, 40, 1, 0.999);
  const SolverResult result = solve(system.transport, system.source, system.reflectance,
                                    {.tolerance = 1e-9, .max_iterations = 3});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_LE(true_error(exact_solution(system), result.radiosity), result.error_bound);
}

TEST(Solve, MillionBouncesConvergeOrAreReported) {
  // Reflectance 1 - 1e-6 in a closed room: B = 1e6 E.
  Eigen::MatrixXd m = Eigen::MatrixXd::Constant(4, 4, 0.25);
  const SolverResult result =
      solve(transport_of({m}), std::vector<Rgb>(4, Rgb(1.0)), std::vector<Rgb>(4, Rgb(1.0 - 1e-6)));
  const double error = std::abs(result.radiosity[0].r / 1e6 - 1.0);
  if (result.converged)
    EXPECT_LT(error, 1e-4);
  else
    EXPECT_GT(result.error_bound, 1e-4);
  // As a share of the values reached, not of those sought.
  EXPECT_LE(std::abs(1e6 - result.radiosity[0].r) / result.radiosity[0].r,
            1.01 * result.error_bound);
}

} // namespace
} // namespace meninas::test
