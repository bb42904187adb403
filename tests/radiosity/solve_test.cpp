#include "radiosity/solve.h"
#include "tests/support/random.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

/// A transport of one or three bands from dense matrices.
Transport transport_of(const std::vector<Eigen::MatrixXd>& bands) {
  Transport transport;
  transport.size = static_cast<std::size_t>(bands[0].rows());
  transport.bands = static_cast<int>(bands.size());
  transport.row_begin.push_back(0);
  for (Eigen::Index i = 0; i < bands[0].rows(); ++i) {
    for (Eigen::Index j = 0; j < bands[0].cols(); ++j) {
      if (bands[0](i, j) == 0.0)
        continue;
      transport.columns.push_back(static_cast<std::uint32_t>(j));
      for (const auto& band : bands)
        transport.weights.push_back(static_cast<float>(band(i, j)));
    }
    transport.row_begin.push_back(transport.columns.size());
  }
  return transport;
}

/// The same numbers as floats: the system that is really solved.
Eigen::MatrixXd dense(const Transport& transport, int band) {
  const auto n = static_cast<Eigen::Index>(transport.size);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < transport.size; ++i)
    for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k) {
      const auto bands = static_cast<std::size_t>(transport.bands);
      matrix(static_cast<Eigen::Index>(i), transport.columns[k]) =
          transport.weights[k * bands + (bands == 1 ? 0 : static_cast<std::size_t>(band))];
    }
  return matrix;
}

struct System {
  Transport transport;
  std::vector<Rgb> source, reflectance;
};

/// Rows that sum to one, as in a closed room.
System random_system(Random& random, int size, int bands, double highest_reflectance,
                     double emission = 1.0) {
  std::vector<Eigen::MatrixXd> matrices;
  for (int b = 0; b < bands; ++b) {
    Eigen::MatrixXd m(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index j = 0; j < size; ++j)
        m(i, j) = random.between(0.01, 1.0);
      m.row(i) /= m.row(i).sum() * (b == 0 ? 1.0 : 1.3);
    }
    matrices.push_back(m);
  }
  System system{transport_of(matrices), {}, {}};
  for (int i = 0; i < size; ++i) {
    system.source.push_back(emission * random.in_box(Vec3(0.0), Vec3(1.0)));
    system.reflectance.push_back(highest_reflectance * random.in_box(Vec3(0.5), Vec3(1.0)));
  }
  return system;
}

std::vector<Rgb> direct_solution(const System& system) {
  const auto n = static_cast<Eigen::Index>(system.transport.size);
  std::vector<Rgb> solution(system.transport.size);
  for (int band = 0; band < 3; ++band) {
    Eigen::MatrixXd a = -dense(system.transport, band);
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      a.row(i) *= system.reflectance[static_cast<std::size_t>(i)][band];
      b(i) = system.source[static_cast<std::size_t>(i)][band];
    }
    a.diagonal().array() += 1.0;
    const Eigen::VectorXd x = a.partialPivLu().solve(b);
    for (Eigen::Index i = 0; i < n; ++i)
      solution[static_cast<std::size_t>(i)][band] = x(i);
  }
  return solution;
}

/// ||B - B_k|| / ||B_k|| in the maximum norm, worst channel: what the error bound bounds.
double true_error(const std::vector<Rgb>& exact, const std::vector<Rgb>& x) {
  double worst = 0.0;
  for (int band = 0; band < 3; ++band) {
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      error = std::max(error, std::abs(exact[i][band] - x[i][band]));
      size = std::max(size, std::abs(x[i][band]));
    }
    if (error > 0.0)
      worst = std::max(worst, error / size);
  }
  return worst;
}

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

TEST(Solve, AgreesWithTheDirectSolution) {
  Random random(1);
  for (const int bands : {1, 3})
    for (const int size : {1, 2, 7, 100, 300})
      for (const double reflectance : {0.1, 0.5, 0.9, 0.99}) {
        const System system = random_system(random, size, bands, reflectance);
        const SolverResult result =
            solve(system.transport, system.source, system.reflectance, {.tolerance = 1e-9});
        EXPECT_TRUE(result.converged) << size << ' ' << reflectance;
        EXPECT_LT(true_error(direct_solution(system), result.radiosity), 1e-9);
      }
}

TEST(Solve, TheBoundBoundsTheErrorAndIsNotIdle) {
  Random random(2);
  for (int k = 0; k < 60; ++k) {
    const System system =
        random_system(random, 3 + k, k % 2 == 0 ? 1 : 3, random.between(0.2, 0.999));
    const double tolerance = std::pow(10.0, random.between(-6, -1));
    const SolverResult result =
        solve(system.transport, system.source, system.reflectance, {.tolerance = tolerance});
    const double error = true_error(direct_solution(system), result.radiosity);
    EXPECT_LE(error, result.error_bound * (1.0 + 1e-9) + 1e-14);
    EXPECT_LE(result.error_bound, tolerance);
    // Rows that all see alike make the bound nearly sharp: an order of magnitude is ample.
    EXPECT_GE(10.0 * error, 0.01 * result.error_bound);
    EXPECT_EQ(result.residuals.size(), static_cast<std::size_t>(result.iterations) + 1);
    EXPECT_EQ(result.residuals.back(), result.residual);
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
  EXPECT_LE(true_error(direct_solution(system), result.radiosity), result.error_bound);
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
