// Progressive radiosity by shots:
// against closed forms, against solutions by rows, and by what holds after any shot.
#include "radiosity/light/element_light.h"
#include "radiosity/solvers/progressive.h"
#include "radiosity/solvers/ray_shots.h"
#include "radiosity/solvers/shooting_blocks.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/radiosity/solvers/radiosity_systems.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

PassOneSettings shooting(double element_size, int rays, double tolerance = 1e-4) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  settings.interpolation.method = Interpolation::average;
  settings.solver = {SolverMethod::progressive, tolerance};
  return settings;
}

double power_of(const LitScene& l, const std::vector<Rgb>& values,
                const std::vector<float>& exposed) {
  double sum = 0.0;
  for (std::size_t e = 0; e < values.size(); ++e)
    sum += l.mesh.area[e] * double{exposed[e]} * values[e].g;
  return sum;
}

double power_of(const LitScene& l, const std::vector<Rgb>& values) {
  return power_of(l, values, std::vector<float>(values.size(), 1.0F));
}

// All walls glow with E = 1: B = 1 / (1 - rho) everywhere. Power is shot without loss, whatever
// the rays: its sum is right to the tolerance. An element is met by some 256 / (1 - rho) rays;
// its error is a few times the inverse root of that of the reflected light.
TEST(Progressive, Furnaces) {
  for (const bool with_mirrors : {false, true})
    for (const double rho : {0.0, 0.5, 0.9}) {
      const auto l = lit(furnace(rho, {with_mirrors}), {.element_size = 0.125});
      const RadiositySolution solution = shoot_pass_one(l->light, shooting(0.125, 256));
      EXPECT_TRUE(solution.solver.converged);
      EXPECT_EQ(solution.solver.bands, 1);
      const double exact = 1.0 / (1.0 - rho);
      double area = 0.0;
      for (const double a : l->mesh.area)
        area += a;
      EXPECT_NEAR(power_of(*l, solution.radiosity) / area, exact, 2e-4 * exact);
      for (const Rgb& b : solution.radiosity)
        EXPECT_NEAR(b.g, exact, 0.15 * rho * exact + 1e-6) << rho;
      // To the rows of 256 rays and the tolerance.
      EXPECT_LT(std::abs(solution.energy.imbalance), 1e-3);
    }
}

// Two independent routes to the same light: shots, and rows.
// Means over nodes differ by the noise of either, which is that of some ten thousand rays.
TEST(Progressive, AgreesWithRowsInGalleryScenes) {
  for (const char* name : {"cornell", "cornell-mirror", "facing-mirrors", "periscope"}) {
    PassOneSettings settings = shooting(0.0, 256);
    settings.mesh.target_elements = 600;
    const auto l =
        lit(load_gltf(source_dir() + "/scenes/gallery/" + name + ".gltf"),
            settings.mesh);
    const RadiositySolution shots = shoot_pass_one(l->light, settings);
    EXPECT_TRUE(shots.solver.converged);
    settings.solver.method = SolverMethod::bicgstab;
    const RadiositySolution rows = solve_pass_one(l->light, settings);
    EXPECT_NEAR(power_of(*l, shots.irradiance, shots.exposed),
                power_of(*l, rows.irradiance, rows.exposed),
                5e-3 * power_of(*l, rows.irradiance, rows.exposed))
        << name;
    for (const char* node : {"floor", "ceiling", "back", "left", "right"})
      if (!elements_of(*l, node).empty()) {
        const double expected = mean_over(*l, rows.irradiance, node).g;
        EXPECT_NEAR(mean_over(*l, shots.irradiance, node).g, expected, 0.015 * expected + 1e-9)
            << name << ' ' << node;
      }
  }
}

// The unit cube of six one-patch faces, known_radiosities_test.cpp:
// reflectance 0.5, the floor emits. One element is one block.
TEST(Progressive, CubeOfSixPatches) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, diffuse(0.5, 1.0), wall, wall, wall});
  PassOneSettings settings = shooting(1e6, 1 << 15, 1e-6);
  settings.direct.points = settings.direct.max_points = 1024;
  settings.direct.shadow_rays = settings.direct.penumbra_rays = settings.direct.rays_in_element = 1;
  const auto l = lit(std::move(scene), settings.mesh);
  const RadiositySolution solution = shoot_pass_one(l->light, settings);
  EXPECT_NEAR(mean_over(*l, solution.radiosity, "y0").r, 1.09090909810769547, 1e-3);
  EXPECT_NEAR(mean_over(*l, solution.radiosity, "z1").r, 0.181836268946129011, 2e-3 * 0.18);
  EXPECT_NEAR(mean_over(*l, solution.radiosity, "y1").r, 0.181745826107788481, 2e-3 * 0.18);
}

// Where elimination runs, shots are by the columns of the transport that it solves for.
TEST(Progressive, AgreesWithEliminationInGalleryScenes) {
  constexpr double tolerance = 1e-6;
  for (const char* name : {"cornell-mirror", "facing-mirrors"}) {
    PassOneSettings settings = shooting(0.0, 64, tolerance);
    settings.mesh.target_elements = 300;
    const auto l =
        lit(load_gltf(source_dir() + "/scenes/gallery/" + name + ".gltf"),
            settings.mesh);
    int looks = 0;
    const RadiositySolution shots =
        solve_pass_one(l->light, settings, {}, {7, [&](const PassOneSoFar& state) {
                                                   EXPECT_GE(state.ambient.g, 0.0);
                                                   looks += 1;
                                                 }});
    EXPECT_TRUE(shots.solver.converged);
    EXPECT_EQ(looks, (shots.solver.iterations + 6) / 7); // the last state among them
    settings.solver.method = SolverMethod::direct;
    const RadiositySolution exact = solve_pass_one(l->light, settings);
    EXPECT_LT(true_error(exact.radiosity, shots.radiosity), 10.0 * tolerance) << name;
    EXPECT_LT(true_error(exact.irradiance, shots.irradiance), 10.0 * tolerance) << name;
  }
}

struct Watched {
  std::unique_ptr<LitScene> lit;
  HemisphereSurvey survey;
  std::vector<Rgb> source, reflectance;
  ShotSolution solution;
  std::vector<ShotsSoFar> states;
};

Watched watched(Scene scene, double element_size, int rays, const SolverSettings& solver,
                int every) {
  Watched w{lit(std::move(scene), {.element_size = element_size}), {}, {}, {}, {}, {}};
  const FormFactorSettings settings{.rays = rays};
  w.survey = survey_hemispheres(*w.lit->light, settings);
  const DirectIrradiance direct = direct_irradiance(*w.lit->light, w.survey.covered, {});
  for (std::size_t e = 0; e < element_count(w.lit->mesh); ++e) {
    w.reflectance.push_back(w.lit->mesh.sides[index(w.lit->mesh.side_of_element[e])].reflectance);
    w.source.push_back(w.reflectance[e] * (direct.irradiance[e] + w.survey.gathered[e]));
  }
  w.solution =
      solve_by_shots(*w.lit->light, w.survey, {w.source, {w.reflectance, {}}}, {settings, solver},
                     {}, {every, [&](const ShotsSoFar& state) { w.states.push_back(state); }});
  return w;
}

double ambient_of(const Watched& w, const ShotsSoFar& state) {
  const Shooters blocks = make_shooting_blocks(w.lit->mesh, w.survey.exposed);
  return ambient_irradiance(blocks.measure, w.survey.closure, state.unshot, w.reflectance).g;
}

// In a closed room of one reflectance the power with
// the ambient term is that of the solution after every shot.
TEST(Progressive, AmbientPowerIsThatOfTheSolution) {
  Scene scene;
  const Material wall = diffuse(0.7);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, diffuse(0.7, 1.0), wall, wall, wall});
  const Watched w = watched(std::move(scene), 0.1, 128, {SolverMethod::progressive, 1e-6}, 1);
  ASSERT_GT(w.states.size(), 20U);
  double direct = 0.0, area = 0.0;
  for (std::size_t e = 0; e < w.source.size(); ++e) {
    direct += w.lit->mesh.area[e] * w.source[e].g / 0.7;
    area += w.lit->mesh.area[e];
  }
  const double exact = direct / 0.3; // H = D + rho D + rho^2 D + ...
  for (const ShotsSoFar& state : w.states)
    EXPECT_NEAR(direct + power_of(*w.lit, state.arrived) + area * ambient_of(w, state), exact,
                1e-4 * exact)
        << state.shots;
  EXPECT_GT(ambient_of(w, w.states.front()), 1e3 * ambient_of(w, w.states.back()));
}

// Mirrors and openings swallow light:
// the ambient term knows, and is nearer to the end than what has arrived alone.
TEST(Progressive, AmbientTermWithMirrorsAndOpenings) {
  const Watched w =
      watched(facing_mirrors(Rgb(0.8)), 0.2, 128, {SolverMethod::progressive, 1e-6}, 1);
  EXPECT_TRUE(w.solution.solver.converged);
  EXPECT_EQ(w.solution.solver.error_bound, 0.0); // black walls reflect nothing: nothing is shot
  ASSERT_EQ(w.states.size(), 1U);
  EXPECT_EQ(w.states[0].shots, 0);

  const Watched room = watched(half_room(), 0.15, 128, {SolverMethod::progressive, 1e-5}, 10);
  const auto& end = room.solution.arrived;
  ASSERT_GT(room.states.size(), 10U);
  double before = 1e300;
  for (const ShotsSoFar& state : room.states) {
    const double without = power_of(*room.lit, end, room.survey.exposed) -
                           power_of(*room.lit, state.arrived, room.survey.exposed);
    EXPECT_LE(without, before);
    before = without;
    double area = 0.0;
    for (std::size_t e = 0; e < end.size(); ++e)
      area += room.lit->mesh.area[e] * double{room.survey.exposed[e]};
    if (without > 1e-3 * power_of(*room.lit, end)) {
      EXPECT_LT(std::abs(without - area * ambient_of(room, state)), 0.35 * without) << state.shots;
    }
  }
}

// ||B - B_k|| <= kappa / (1 - kappa) ||U_k||:
// the power that is still to come, of a run that goes on with the very same shots.
TEST(Progressive, TheBoundBoundsWhatIsToCome) {
  SolverSettings long_run{SolverMethod::progressive, 1e-9};
  const Watched end = watched(half_room(), 0.25, 64, long_run, 0);
  EXPECT_TRUE(end.solution.solver.converged);
  std::vector<double> powers;
  for (const int shots : {1, 5, 20, 80}) {
    SolverSettings some = long_run;
    some.max_shots = shots;
    const Watched w = watched(half_room(), 0.25, 64, some, 0);
    EXPECT_EQ(w.solution.solver.iterations, shots);
    EXPECT_EQ(w.solution.solver.residuals.size(), static_cast<std::size_t>(shots) + 1);
    EXPECT_EQ(w.solution.solver.end, SolverEnd::iteration_limit);
    EXPECT_FALSE(w.solution.solver.converged);
    const double reached = power_of(*w.lit, w.solution.solver.radiosity, w.survey.exposed);
    const double missing =
        power_of(*w.lit, end.solution.solver.radiosity, w.survey.exposed) - reached;
    const double bound = w.solution.solver.channel_error_bounds.back().g;
    EXPECT_GT(missing, 0.0);
    EXPECT_LE(missing / reached, bound * (1.0 + 1e-6));
    EXPECT_GE(20.0 * missing / reached, bound); // reflectances are uneven, but it is not idle
    powers.push_back(reached);
  }
  EXPECT_TRUE(std::ranges::is_sorted(powers));
}

TEST(Progressive, TheBrightestBlockShootsFirst) {
  const Watched w = watched(half_room(), 0.25, 64, {SolverMethod::progressive, 1e-4, 10'000, 1}, 1);
  const Shooters blocks = make_shooting_blocks(w.lit->mesh, w.survey.exposed);
  const auto power = [&](std::size_t block) {
    Rgb sum(0.0);
    for (const auto e : blocks.members(block))
      sum += blocks.measure[e] * w.source[e];
    return sum;
  };
  Rgb total(0.0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    total += power(b);
  double most = 0.0;
  std::size_t brightest = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Rgb share = power(b) / total;
    if (const double s = std::max({share.r, share.g, share.b}); s > most) {
      most = s;
      brightest = b;
    }
  }
  // Its own plane receives nothing, and no more arrives than it had.
  for (const auto e : blocks.members(brightest))
    EXPECT_EQ(w.solution.arrived[e], Rgb(0.0));
  double arrived = 0.0;
  for (std::size_t e = 0; e < w.source.size(); ++e)
    arrived += blocks.measure[e] * w.solution.arrived[e].g;
  EXPECT_GT(arrived, 0.5 * power(brightest).g);
  EXPECT_LE(arrived, power(brightest).g * (1.0 + 1e-6));
}

TEST(Progressive, SameBitsForAnyThreadCount) {
  std::vector<RadiositySolution> runs;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const auto l = lit(half_room_with_small_mirror(), {.element_size = 0.15});
    runs.push_back(shoot_pass_one(l->light, shooting(0.15, 256)));
  }
  for (const auto& run : runs) {
    EXPECT_EQ(run.radiosity, runs[0].radiosity);
    EXPECT_EQ(run.irradiance, runs[0].irradiance);
    EXPECT_EQ(run.solver.residuals, runs[0].solver.residuals);
    EXPECT_EQ(run.form_factor_rays, runs[0].form_factor_rays);
  }
}

TEST(Progressive, RoomsWithoutAbsorptionAreFoundOut) {
  const auto closed = lit(furnace(1.0, {true}), {.element_size = 0.25});
  EXPECT_EQ(shoot_pass_one(closed->light, shooting(0.25, 64)).solver.end, SolverEnd::unsolvable);

  // A lit box of perfect walls inside an ordinary room, and the same box dark.
  for (const double emission : {1.0, 0.0}) {
    Scene scene = furnace(0.5, {});
    const Material wall = diffuse(1.0, emission);
    add_room(scene, Point3(0.25), Point3(0.75), {wall, wall, wall, wall, wall, wall});
    const auto l = lit(std::move(scene), {.element_size = 0.25});
    const SolverResult solver = shoot_pass_one(l->light, shooting(0.25, 64)).solver;
    EXPECT_EQ(solver.end, SolverEnd::converged);
    EXPECT_EQ(solver.trapped.empty(), emission == 0.0);
  }
}

/// A ceiling of the unit room from (x0, z0) to (x1, z1).
void add_ceiling(Scene& scene, const std::string& name, double x0, double z0, double x1, double z1,
                 const Material& material) {
  add_polygon(scene, name, {{x0, 1, z0}, {x1, 1, z0}, {x1, 1, z1}, {x0, 1, z1}}, material);
}

// Reflectance one, with a way out: a black window in the ceiling, which rays of many elements miss.
// All of the light of the floor ends there.
TEST(Progressive, PerfectWallsOfAnOpenBox) {
  for (const double half : {0.5, 0.1}) {
    Scene scene;
    const Material wall = diffuse(1.0);
    add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, diffuse(1.0, 1.0), wall, wall, wall});
    std::erase_if(scene.triangles,
                  [&](const Triangle& t) { return scene.nodes[index(t.node)].name == "y1"; });
    const double low = 0.5 - half, high = 0.5 + half;
    add_ceiling(scene, "window", low, low, high, high, diffuse(0.0));
    if (half < 0.5) {
      add_ceiling(scene, "ceiling", 0, 0, 1, low, wall);
      add_ceiling(scene, "ceiling", 0, high, 1, 1, wall);
      add_ceiling(scene, "ceiling", 0, low, low, high, wall);
      add_ceiling(scene, "ceiling", high, low, 1, high, wall);
    }
    const auto l = lit(std::move(scene), {.element_size = 0.25});
    const RadiositySolution solution = shoot_pass_one(l->light, shooting(0.25, 256, 1e-3));
    EXPECT_TRUE(solution.solver.converged) << solution.solver.error_bound;
    double absorbed = 0.0;
    for (const std::size_t e : elements_of(*l, "window"))
      absorbed += l->mesh.area[e] * solution.irradiance[e].g;
    EXPECT_NEAR(absorbed, 1.0, 5e-3);
  }
}

// Emission over 24 orders, also between the channels;
// sizes over 12. The same rays carry the same shares.
TEST(Progressive, EmissionAndSizeMakeNoDifference) {
  const auto solved = [](double scale, const Rgb& emission) {
    Scene scene = transformed(half_room(), glm::dmat3(1.0), scale, Vec3(0.0));
    for (auto& material : scene.materials)
      material.emission *= emission;
    const auto l = lit(std::move(scene), {.element_size = 0.25 * scale});
    RadiositySolution solution = shoot_pass_one(l->light, shooting(0.25 * scale, 64, 1e-3));
    EXPECT_TRUE(solution.solver.converged);
    for (Rgb& h : solution.irradiance)
      h /= emission;
    return solution.irradiance;
  };
  const auto expected = solved(1.0, Rgb(1.0));
  const auto total = [](const std::vector<Rgb>& values) {
    Rgb sum(0.0);
    for (const Rgb& v : values)
      sum += v;
    return sum;
  };
  for (const auto& [scale, emission] : {std::pair{1.0, Rgb(1e-12)},
                                        {1.0, Rgb(1e12)},
                                        {1.0, Rgb(1e12, 1.0, 1e-12)},
                                        {1e-6, Rgb(1.0)},
                                        {1e6, Rgb(1.0)}}) {
    const auto found = solved(scale, emission);
    const Rgb share = total(found) / total(expected);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(share[band], 1.0, 2e-3) << scale; // of the tolerance
  }
}

TEST(Progressive, NothingToShoot) {
  Scene dark = half_room();
  for (auto& material : dark.materials)
    material.emission = Rgb(0.0);
  const auto l = lit(std::move(dark), {.element_size = 0.5});
  const RadiositySolution solution = shoot_pass_one(l->light, shooting(0.5, 16));
  EXPECT_TRUE(solution.solver.converged);
  EXPECT_EQ(solution.solver.iterations, 0);
  const auto mirrors =
      lit(furnace(0.5, {true, true, true, true, true, true}), {.element_size = 0.5});
  EXPECT_TRUE(shoot_pass_one(mirrors->light, shooting(0.5, 16)).radiosity.empty());
}

} // namespace
} // namespace meninas::test
