// Sweeps of Jacobi's method as a watch is told of them: one bounce of light more each.
#include "tests/radiosity/solvers/radiosity_systems.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

// Both are the same sums in double; 1e-12 is a few thousand roundings.
TEST(Sweeps, BringOneBounceEach) {
  Random random(5);
  const System system = random_system(random, 40, 3, 0.8);
  std::vector<ShotsSoFar> told;
  ShotPlan plan;
  plan.watch = {1, [&](const ShotsSoFar& state) { told.push_back(state); }};
  const SolverResult result =
      solve(system.transport, system.source, system.reflectance, {SolverMethod::jacobi, 1e-6, 1000}, plan);
  ASSERT_GE(told.size(), 5U);
  EXPECT_EQ(told.size(), static_cast<std::size_t>(result.iterations));
  std::vector<Rgb> x = system.source;
  for (std::size_t k = 0; k < told.size(); ++k) {
    const std::vector<Rgb> arrived = apply_transport(system.transport, x);
    EXPECT_EQ(told[k].shots, static_cast<int>(k) + 1);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Rgb next = system.source[i] + system.reflectance[i] * arrived[i];
      for (int band = 0; band < 3; ++band) {
        EXPECT_NEAR(told[k].arrived[i][band], arrived[i][band], 1e-12);
        EXPECT_NEAR(told[k].unshot[i][band], next[band] - x[i][band], 1e-12);
      }
      x[i] = next;
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(x[i].g, result.radiosity[i].g, 1e-12);
}

TEST(Sweeps, ChangeNothingWhereTheyAreWatched) {
  Random random(6);
  const System system = random_system(random, 30, 1, 0.7);
  const SolverSettings settings{SolverMethod::jacobi, 1e-5, 1000};
  ShotPlan plan;
  int looks = 0;
  plan.watch = {3, [&](const ShotsSoFar&) { ++looks; }};
  const SolverResult watched = solve(system.transport, system.source, system.reflectance, settings, plan);
  const SolverResult alone = solve(system.transport, system.source, system.reflectance, settings);
  EXPECT_EQ(watched.radiosity, alone.radiosity);
  EXPECT_EQ(looks, (watched.iterations + 2) / 3) << "every third, and the last";
}

} // namespace
} // namespace meninas::test
