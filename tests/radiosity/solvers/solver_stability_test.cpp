// Every solver under every condition: right within its tolerance, or honest about it.
#include "scenes/errors.h"
#include "tests/radiosity/solvers/radiosity_systems.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

class Solvers : public testing::TestWithParam<SolverMethod> {
protected:
  SolverResult run(const System& system, double tolerance = 1e-8,
                   int max_iterations = SolverSettings{}.max_iterations) const {
    return solve(system.transport, system.source, system.reflectance,
                 {GetParam(), tolerance, max_iterations});
  }
  /// What counts for one of max_iterations.
  int iteration_of(const System& system) const {
    return GetParam() == SolverMethod::progressive ? static_cast<int>(system.source.size()) : 1;
  }
};

INSTANTIATE_TEST_SUITE_P(Each, Solvers, testing::ValuesIn(solver_methods), [](const auto& method) {
  std::string name = name_of(method.param);
  std::erase(name, '-');
  return name;
});

System closed_room(int size, double reflectance) {
  Random random(99);
  System system = random_system(random, size, 1, 1.0);
  system.reflectance.assign(system.reflectance.size(), Rgb(reflectance));
  return system;
}

// A scene of mirrors alone has no element.
TEST_P(Solvers, NothingAtAllIsSolved) {
  System system;
  system.transport.row_begin = {0};
  const SolverResult result = run(system);
  EXPECT_TRUE(result.converged);
  EXPECT_TRUE(result.radiosity.empty());
}

TEST_P(Solvers, AgreeWithElimination) {
  Random random(11);
  for (const int bands : {1, 3})
    for (const int size : {1, 2, 7, 60, 150})
      for (const double reflectance : {0.1, 0.5, 0.9, 0.99}) {
        const System system = random_system(random, size, bands, reflectance);
        const SolverResult result = run(system);
        EXPECT_TRUE(result.converged) << size << ' ' << reflectance;
        EXPECT_LT(true_error(exact_solution(system), result.radiosity), 1e-8);
      }
}

TEST_P(Solvers, AreasEmissionsAndReflectancesOverManyOrders) {
  Random random(12);
  for (int k = 0; k < 12; ++k) {
    System system = reciprocal_system(random, 40, 12.0, 1.0).system;
    for (std::size_t i = 0; i < system.source.size(); ++i) {
      const double kind = random.between(0.0, 3.0);
      system.reflectance[i] = kind < 1.0 ? Rgb(0.0) : kind < 2.0 ? Rgb(0.999) : Rgb(0.5);
      system.source[i] *= std::pow(10.0, random.between(-12.0, 12.0));
    }
    const SolverResult result = run(system);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(true_error(exact_solution(system), result.radiosity), 1e-8);
  }
}

// Channels have coefficients and histories of their own:
// one that is 1e24 times dimmer is solved as well.
TEST_P(Solvers, DimChannelsAreSolvedAsWell) {
  Random random(13);
  System system = random_system(random, 50, 3, 0.95);
  for (auto& source : system.source)
    source *= Rgb(1e12, 1.0, 1e-12);
  const SolverResult result = run(system);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(true_error(exact_solution(system), result.radiosity), 1e-8);
  EXPECT_LE(result.channel_error_bounds.size(), static_cast<std::size_t>(result.iterations) + 1);
  EXPECT_EQ(result.channel_error_bounds.size(), result.residuals.size());
  EXPECT_EQ(result.channel_residuals.size(), result.residuals.size());
}

TEST_P(Solvers, LinearInEmission) {
  Random random(14);
  const System a = reciprocal_system(random, 60, 3.0, 0.9).system;
  System b = a, sum = a;
  for (std::size_t i = 0; i < a.source.size(); ++i) {
    b.source[i] = random.in_box(Vec3(0.0), Vec3(1.0));
    sum.source[i] = 2.0 * a.source[i] + 3.0 * b.source[i];
  }
  const auto xa = run(a).radiosity, xb = run(b).radiosity, xs = run(sum).radiosity;
  std::vector<Rgb> expected;
  for (std::size_t i = 0; i < xa.size(); ++i)
    expected.push_back(2.0 * xa[i] + 3.0 * xb[i]);
  EXPECT_LT(true_error(expected, xs), 3e-8); // of three solutions
}

// A_i / rho_i (1 - rho T) is symmetric where form factors are reciprocal, and so is its inverse:
// the light of rho_i / A_i at i makes as bright an element
// j as the light of rho_j / A_j at j makes element i.
TEST_P(Solvers, LightGoesBothWays) {
  Random random(15);
  const auto [base, area] = reciprocal_system(random, 30, 2.0, 0.9);
  const auto response = [&](std::size_t from, std::size_t to) {
    System system = base;
    system.source.assign(system.source.size(), Rgb(0.0));
    system.source[from] = system.reflectance[from] / area[from];
    return run(system, 1e-10).radiosity[to];
  };
  for (std::size_t k = 0; k < 10; ++k) {
    const Rgb there = response(k, 29 - k), back = response(29 - k, k);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(there[band] / back[band], 1.0,
                  1e-5); // weights are floats, values small parts of the largest
  }
}

TEST_P(Solvers, MoreEmissionNeverDarkensAndNothingIsNegative) {
  Random random(16);
  for (int k = 0; k < 10; ++k) {
    const double tolerance = std::pow(10.0, random.between(-8.0, -1.0));
    System system = random_system(random, 50, 3, 0.97);
    for (auto& source : system.source)
      source *= random.between(0.0, 1.0) < 0.9 ? 0.0 : 1.0;
    const SolverResult before = run(system, tolerance);
    System brighter = system;
    brighter.source[static_cast<std::size_t>(k)] += Rgb(0.3);
    const SolverResult after = run(brighter, tolerance);
    double largest = 0.0;
    for (const auto& b : after.radiosity)
      largest = std::max({largest, b.r, b.g, b.b});
    for (std::size_t i = 0; i < before.radiosity.size(); ++i)
      for (int band = 0; band < 3; ++band) {
        EXPECT_GE(before.radiosity[i][band], system.source[i][band]);
        EXPECT_GE(after.radiosity[i][band], before.radiosity[i][band] - 2.0 * tolerance * largest);
      }
  }
}

// Reflectance 1 - 1e-6 in a closed room: B = 1e6 E, or a bound that says how far it is from there.
TEST_P(Solvers, AMillionBounces) {
  System system = closed_room(80, 1.0 - 1e-6);
  system.source.assign(system.source.size(), Rgb(1.0));
  const SolverResult even = run(system, 1e-3);
  Random random(17);
  for (auto& source : system.source)
    source = random.in_box(Vec3(0.0), Vec3(1.0));
  const SolverResult uneven = run(system, 1e-3);
  const bool sweeps =
      GetParam() != SolverMethod::direct && GetParam() != SolverMethod::bicgstab; // or shots
  for (const SolverResult* result : {&even, &uneven}) {
    EXPECT_NE(result->converged, sweeps);
    EXPECT_EQ(result->end, sweeps ? SolverEnd::iteration_limit : SolverEnd::converged);
    EXPECT_TRUE(std::isfinite(result->error_bound));
  }
  if (!sweeps) {
    EXPECT_NEAR(even.radiosity[7].g, 1e6, 1e3 + 1e6 * 0.02); // rows of floats close to 1e-8
    EXPECT_LT(true_error(exact_solution(system), uneven.radiosity), 1e-3);
  } else {
    EXPECT_LT(true_error(exact_solution(system), uneven.radiosity), uneven.error_bound);
  }
}

// A long white corridor that light leaves at its ends alone:
// a bound of the error would take as many iterations as there are patches.
// Where none can be had, iterating ends when the residual is small, and nothing else is claimed.
TEST(SolverStop, WithoutABoundTheResidualDecides) {
  constexpr std::size_t size = 3000;
  Transport transport{.size = size, .bands = 1, .row_begin = {0}, .columns = {}, .weights = {}};
  for (std::uint32_t i = 0; i < size; ++i) {
    for (const std::uint32_t other : {i - 1, i + 1})
      if (other < size) {
        transport.columns.push_back(other);
        transport.weights.push_back(0.5F);
      }
    transport.row_begin.push_back(transport.columns.size());
  }
  std::vector<Rgb> source(size, Rgb(0.0));
  source[size / 2] = Rgb(1.0);
  const double tolerance = 0.02;
  const SolverResult result = solve(transport, source, std::vector<Rgb>(size, Rgb(1.0)),
                                    {SolverMethod::bicgstab, tolerance});
  EXPECT_EQ(result.error_bound, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(result.converged);
  EXPECT_LE(result.residual, tolerance);
  EXPECT_LT(result.iterations, 60);
}

TEST_P(Solvers, AClosedRoomOfReflectanceOneHasNoSolution) {
  const System system = closed_room(50, 1.0);
  const SolverResult result = run(system);
  EXPECT_EQ(result.end, SolverEnd::unsolvable);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.error_bound, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.radiosity, system.source);
}

// Two rooms without a connection, the second a trap:
// what is in it reflects nothing, and the first is as ever.
TEST_P(Solvers, ATrapMattersWhereThereIsLightInIt) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(4, 4);
  m.topLeftCorner(2, 2).setConstant(0.4);
  m.bottomRightCorner(2, 2).setConstant(0.5);
  System system{transport_of({m}), std::vector<Rgb>(4, Rgb(0.0)), std::vector<Rgb>(4, Rgb(1.0))};
  system.source[0] = Rgb(1.0, 0.0, 0.0);
  // In the first room B_0 = S + 0.4 (B_0 + B_1), B_1 = 0.4 (B_0 + B_1);
  // nobody asks how light would grow in the other.
  const SolverResult lit = run(system);
  EXPECT_TRUE(lit.converged);
  EXPECT_LT(lit.error_bound, 1e-8);
  EXPECT_NEAR(lit.radiosity[0].r, 3.0, 3e-8 + 3e-7); // weights are floats
  EXPECT_NEAR(lit.radiosity[1].r, 2.0, 3e-8 + 3e-7);
  EXPECT_EQ(lit.radiosity[3], Rgb(0.0));
  EXPECT_TRUE(lit.trapped.empty());
  system.source[3] = Rgb(0.0, 0.0, 5.0);
  const SolverResult trapped = run(system);
  EXPECT_TRUE(trapped.converged);
  EXPECT_EQ(trapped.trapped, std::vector<std::uint32_t>{3});
  EXPECT_NEAR(trapped.radiosity[0].r, 3.0, 3e-8 + 3e-7);
  EXPECT_NEAR(trapped.radiosity[1].r, 2.0, 3e-8 + 3e-7);
  EXPECT_EQ(trapped.radiosity[2], Rgb(0.0));
  EXPECT_EQ(trapped.radiosity[3], system.source[3]);

  // All light in it: there is no solution.
  system.source[0] = Rgb(0.0);
  EXPECT_EQ(run(system).end, SolverEnd::unsolvable);

  // One patch that absorbs a millionth is a way out for all.
  system.reflectance[2] = Rgb(1.0 - 1e-6);
  EXPECT_NE(run(system, 1e-4, 50).end, SolverEnd::unsolvable);
}

// Few rays to a coat may all meet it where it lets in more than its mean: then the row sums to more than one. Where
// such rows are white and look at one another light grows on every way round, whatever leaves by the third.
TEST_P(Solvers, RowsThatGatherMoreThanAllThereIsHaveNoBound) {
  Eigen::MatrixXd transport(3, 3);
  transport << 0.0, 1.05, 0.0, 1.05, 0.0, 0.01, 0.0, 0.01, 0.0;
  const System system{transport_of({transport}), {Rgb(1.0), Rgb(0.0), Rgb(0.0)}, std::vector<Rgb>(3, Rgb(1.0))};
  const SolverResult result = run(system);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.error_bound, std::numeric_limits<double>::infinity());
  // A hundred sweeps are three hundred shots of a row, a bounce each: the sum of 1.05^k up to there is 4.5e7.
  for (const Rgb& light : result.radiosity) {
    EXPECT_GE(light.r, 0.0);
    EXPECT_LT(light.r, 1e8);
  }
}

// Reflectance one, but every patch sees a hole in the end:
// patch k sees k + 1, the last one the sky.
TEST_P(Solvers, ReflectanceOneWithAWayOut) {
  constexpr int size = 12;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i + 1 < size; ++i)
    m(i, i + 1) = m(i + 1, i) = 0.5;
  m(0, 0) = 0.5;
  System system{transport_of({m}), std::vector<Rgb>(size, Rgb(1.0)),
                std::vector<Rgb>(size, Rgb(1.0))};
  const SolverResult result = run(system, 1e-6);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(true_error(exact_solution(system), result.radiosity), 1e-6);
}

TEST_P(Solvers, GreySystemsAreSolvedInOneBand) {
  Random random(18);
  System system = random_system(random, 40, 1, 0.9);
  for (auto* values : {&system.source, &system.reflectance})
    for (auto& value : *values)
      value = Rgb(value.g);
  const SolverResult grey = run(system);
  EXPECT_EQ(grey.bands, 1);
  system.reflectance[3].r *= 0.5;
  const SolverResult coloured = run(system);
  EXPECT_EQ(coloured.bands, 3);
  // Green and blue are the grey system's.
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(grey.radiosity[i].r, grey.radiosity[i].b);
    EXPECT_NEAR(coloured.radiosity[i].b, grey.radiosity[i].b, 2e-8 * 10.0);
  }
}

TEST_P(Solvers, SameBitsForAnyThreadCount) {
  Random random(19);
  const System system = random_system(random, 300, 3, 0.95);
  const SolverResult all = run(system);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(run(system).radiosity, all.radiosity);
}

TEST_P(Solvers, TheLimitOfIterationsIsReported) {
  Random random(20);
  const System system = random_system(random, 60, 1, 0.999);
  const SolverResult result = run(system, 1e-15, 1);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, iteration_of(system));
  EXPECT_EQ(result.end, SolverEnd::iteration_limit);
  EXPECT_LE(true_error(exact_solution(system), result.radiosity), result.error_bound + 1e-15);
}

TEST_P(Solvers, BelowRoundingNothingRunsForEver) {
  Random random(21);
  const System system = random_system(random, 60, 3, 0.99);
  const SolverResult result = run(system, 1e-20);
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.iterations, 5000 * iteration_of(system));
  EXPECT_LT(true_error(exact_solution(system), result.radiosity), 1e-12);
}

// The amplification 1 / (1 - rho) grows tenfold from room to room.
// Iterations of a Krylov method need grow no faster than its root, sqrt(10):
// here the light is even after a few bounces, and they hardly grow at all. Sweeps grow tenfold.
TEST(KrylovSolver, IterationsGrowSlowlyTowardsReflectanceOne) {
  std::vector<int> iterations;
  for (const double absorbed : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const System system = closed_room(200, 1.0 - absorbed);
    const SolverResult result =
        solve(system.transport, system.source, system.reflectance, {SolverMethod::bicgstab, 1e-4});
    EXPECT_TRUE(result.converged) << absorbed;
    iterations.push_back(result.iterations);
  }
  EXPECT_LE(iterations.back(), 3 * iterations.front());
}

// Light that goes from one unknown to the next, around a ring of 30,000: a step finds two more of them, and after 10,000
// steps, the most that are allowed, most would still be dark. What stands still ends.
TEST(KrylovSolver, ARunThatStandsStillEnds) {
  constexpr std::uint32_t size = 30'000;
  System ring;
  ring.transport.size = size;
  ring.transport.bands = 1;
  ring.transport.row_begin.push_back(0);
  for (std::uint32_t i = 0; i < size; ++i) {
    ring.transport.columns.push_back((i + 1) % size);
    ring.transport.weights.push_back(1.0F);
    ring.transport.row_begin.push_back(i + 1);
  }
  ring.source.assign(size, Rgb(0.0));
  ring.source[0] = Rgb(1.0);
  ring.reflectance.assign(size, Rgb(0.9999));
  const SolverResult result =
      solve(ring.transport, ring.source, ring.reflectance, {SolverMethod::bicgstab, 1e-4});
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.iterations, 1000);
}

TEST(DirectSolver, LargeSystemsAreRefused) {
  EXPECT_NO_THROW(check_size(SolverMethod::direct, max_direct_unknowns));
  EXPECT_THROW(check_size(SolverMethod::direct, max_direct_unknowns + 1), UsageError);
  EXPECT_NO_THROW(check_size(SolverMethod::bicgstab, 1'000'000));
}

} // namespace
} // namespace meninas::test
