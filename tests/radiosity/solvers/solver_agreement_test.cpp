// Solvers against one another and against closed forms, on whole scenes.
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_system.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace meninas::test {
namespace {

constexpr DirectSettings four_points{.points = 4, .max_points = 4};

TEST(SolverAgreement, EveryGallerySceneWithinTenTolerancesOfTheDirectSolution) {
  constexpr double tolerance = 1e-6;
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_dir() + "/scenes/gallery")) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb")
      continue;
    const auto l = lit(load_gltf(entry.path()), {.target_elements = 150});
    if (element_count(l->mesh) > 1000)
      continue; // of many small patches: elimination would take its time
    ++scenes;
    const System system = system_of(*l, {.rays = 64}, four_points);
    const SolverResult direct = solve(system.transport, system.source, system.reflectance,
                                      {SolverMethod::direct, tolerance});
    EXPECT_TRUE(direct.converged);
    for (const SolverMethod method : solver_methods) {
      const SolverResult result =
          solve(system.transport, system.source, system.reflectance, {method, tolerance});
      EXPECT_TRUE(result.converged) << entry.path() << name_of(method);
      EXPECT_LT(true_error(direct.radiosity, result.radiosity), 10.0 * tolerance)
          << entry.path() << name_of(method);
    }
  }
  EXPECT_GE(scenes, 9);
}

double mean_of(const LitScene& lit, const std::vector<Rgb>& values, const std::string& node) {
  return mean_over(lit, values, node).g;
}

// Two plates of reflectance rho between four perfect mirrors are infinite:
// B1 = E / (1 - rho^2), B2 = rho B1. Rays bring the light of worlds that are not enumerated, with
// an error of a percent of that small part; of the 129 enumerated ones all count at every point.
TEST(SolverAgreement, InfinitePlatesBetweenMirrors) {
  for (const double rho : {0.3, 0.9, 0.99}) {
    Scene scene;
    const Material glass = mirror(1.0);
    add_room(scene, Point3(0.0), Point3(1.0),
             {glass, glass, diffuse(rho, 1.0), diffuse(rho), glass, glass});
    const auto l = lit(std::move(scene), {.element_size = 0.25});
    const System system =
        system_of(*l, {.rays = 1024}, {.points = 4, .max_points = 4, .images_in_element = 1000});
    for (const SolverMethod method : solver_methods) {
      const SolverResult result =
          solve(system.transport, system.source, system.reflectance, {method, 1e-5});
      EXPECT_TRUE(result.converged);
      const double floor = 1.0 + mean_of(*l, result.radiosity, "y0");
      const double ceiling = mean_of(*l, result.radiosity, "y1");
      const double exact = 1.0 / (1.0 - rho * rho);
      EXPECT_NEAR(floor, exact, 2e-3 * exact) << name_of(method) << rho;
      EXPECT_NEAR(ceiling, rho * exact, 2e-3 * exact) << name_of(method) << rho;
    }
  }
}

// B = E / (1 - rho) with rho = 1 - 1e-6.
// Rows are counts of 2^8 rays: they close without any rounding.
TEST(SolverAgreement, FurnaceOfAMillionBounces) {
  const double rho = 1.0 - 1e-6;
  for (const bool with_mirrors : {false, true}) {
    const auto l = lit(furnace(rho, {with_mirrors}), {.element_size = 0.25});
    const System system = system_of(*l, {.rays = 256}, four_points);
    for (const SolverMethod method : {SolverMethod::direct, SolverMethod::bicgstab}) {
      const SolverResult result =
          solve(system.transport, system.source, system.reflectance, {method, 1e-3});
      EXPECT_TRUE(result.converged);
      for (const auto& reflected : result.radiosity)
        EXPECT_NEAR(reflected.g + 1.0, 1e6, 1e3);
    }
    const SolverResult sweeps = solve(system.transport, system.source, system.reflectance,
                                      {SolverMethod::jacobi, 1e-3, 200});
    EXPECT_EQ(sweeps.end, SolverEnd::iteration_limit);
  }
}

TEST(SolverAgreement, FurnaceWithoutAbsorption) {
  const auto l = lit(furnace(1.0, {true}), {.element_size = 0.25});
  const System system = system_of(*l, {.rays = 256}, four_points);
  EXPECT_EQ(solve(system.transport, system.source, system.reflectance).end, SolverEnd::unsolvable);
}

} // namespace
} // namespace meninas::test
