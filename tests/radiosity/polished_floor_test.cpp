// Coats that are mirrors to the light of surfaces:
// R(cos) of it over what is scattered below, in every transport of pass one.
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/solvers/hemisphere_survey.h"
#include "tests/radiosity/solved.h"
#include "tests/support/coats.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.25;
  settings.form_factors.rays = 256;
  settings.form_factors.hemicube_resolution = 32;
  settings.interpolation.method = Interpolation::average;
  settings.solver.tolerance = 1e-4;
  return settings;
}

/// A floor about the origin under a ceiling that is higher by 2.5.
Scene floor_and_ceiling(const Material& floor) {
  Scene scene;
  add_polygon(scene, "ceiling", {{-4, 2.5, -4}, {4, 2.5, -4}, {4, 2.5, 4}, {-4, 2.5, 4}},
              diffuse(0.5));
  add_polygon(scene, "floor", {{-0.4, 0, 2}, {1.1, 0, 2}, {1.1, 0, -2}, {-0.4, 0, -2}}, floor);
  return scene;
}

TEST(PolishedFloor, ThrowsTheImageOfAPointLight) {
  Scene scene = floor_and_ceiling(polished(Rgb(0.0)));
  const Point3 lamp{0.5, 1.0, 0.3}, image{0.5, -1.0, 0.3};
  PunctualLight light;
  light.position = lamp;
  light.intensity = Rgb(7.0);
  scene.lights = {light};
  const auto l = lit(scene, {.element_size = 1.0});
  const PlaneId ceiling = l->mesh.sides[0].plane_class;
  DirectWorkspace work;
  int through = 0, beside = 0;
  for (double x = -3.9; x < 4.0; x += 0.1) {
    const Point3 at{x, 2.5, -0.2};
    const auto irradiance = [&](const Point3& from, double share) {
      const Vec3 to = from - at;
      const double d2 = glm::dot(to, to), cosine = -to.y / std::sqrt(d2);
      return share * 7.0 * cosine / d2;
    };
    // The line from the image crosses the floor at 2/7 of the way.
    const double crossing = 0.5 + (x - 0.5) / 3.5;
    const bool seen = crossing > -0.4 && crossing < 1.1;
    ++(seen ? through : beside);
    const double cosine = 3.5 / glm::distance(image, at);
    const double straight = irradiance(lamp, 1.0);
    const double mirrored = seen ? irradiance(image, coat_reflectance(cosine)) : 0.0;
    const ArrivingLight found =
        direct_irradiance(*l->light, {at, {0, -1, 0}, ceiling, Vec3(0.0)}, {}, 0, work);
    EXPECT_NEAR(found.total.g, straight + mirrored, 1e-12 * straight) << x;
    EXPECT_NEAR(found.mirrored.g, mirrored, 1e-12 * straight) << x;
  }
  EXPECT_GT(through, 40);
  EXPECT_GT(beside, 20);
}

// A coat keeps a part of the light of the sky, which is no light that mirrors brought or took.
TEST(PolishedFloor, HasNoLightByMirrorsWhereThereAreNone) {
  Scene scene = floor_and_ceiling(polished(Rgb(0.5)));
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  scene.background = Rgb(1.0);
  PassOneSettings settings = coarse();
  settings.interpolation = {.method = Interpolation::gather, .rays = 256};
  const Solved lit_floor = solved(scene, settings);
  const IrradianceField& field = lit_floor.solution.field;
  ASSERT_FALSE(field.mirrored.empty());
  for (std::size_t v = 0; v < field.mirrored.size(); ++v) {
    EXPECT_GT(field.irradiance[v].g, 1.0F);
    EXPECT_EQ(field.mirrored[v].g, 0.0F);
    EXPECT_EQ(field.indirect_mirrored[v].g, 0.0F);
  }
}

TEST(PolishedFloor, LetsInWhatItDoesNotReflect) {
  // A sun at 70 degrees from the zenith: what gets below is H (1 - R) / (1 - R_mean).
  Scene scene = floor_and_ceiling(polished(Rgb(0.5)));
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.intensity = Rgb(3.0);
  const double cosine = std::cos(70.0 * std::numbers::pi / 180.0);
  sun.direction = {std::sqrt(1.0 - cosine * cosine), -cosine, 0.0};
  scene.lights = {sun};
  const auto l = lit(scene, {.element_size = 1.0});
  PassOneSettings settings = coarse();
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  const double below =
      3.0 * cosine * (1.0 - coat_reflectance(cosine)) / (1.0 - mean_coat_reflectance);
  for (const Rgb& irradiance : solution.irradiance)
    EXPECT_NEAR(irradiance.g, below, 1e-9);
  EXPECT_NEAR(solution.radiosity[0].g, 0.5 * (1.0 - mean_coat_reflectance) * below, 1e-9);
}

TEST(PolishedFloor, IsAMirrorWhereTheCoatReflectsEverything) {
  // An index of refraction of 0 stands for F0 = 1.
  Scene with_mirror = half_room();
  // Last, so that the elements of the others have the same numbers, with or without any on it.
  std::ranges::stable_partition(with_mirror.triangles, [&](const Triangle& triangle) {
    return !is_mirror(with_mirror.materials[index(triangle.material)]);
  });
  Scene with_coat = with_mirror;
  for (Material& material : with_coat.materials)
    if (is_mirror(material)) {
      material = polished(Rgb(0.8));
      material.ior = 0.0;
    }
  const auto irradiances = [](const Scene& scene) {
    const auto l = lit(scene, coarse().mesh);
    const RadiositySolution solution = solve_pass_one(l->light, coarse());
    std::vector<Rgb> means;
    for (const char* wall : {"x1", "y0", "y1", "z0", "z1"})
      means.push_back(mean_over(*l, solution.irradiance, wall));
    return means;
  };
  const auto mirrored = irradiances(with_mirror), coated_over = irradiances(with_coat);
  // The same rays, in single precision.
  for (std::size_t k = 0; k < mirrored.size(); ++k)
    EXPECT_NEAR(mirrored[k].g, coated_over[k].g, 1e-5 * mirrored[k].g) << k;
}

TEST(PolishedFloor, IsWhiteUnderAWhiteSky) {
  // What the coat reflects and what comes from below it add up to the sky,
  // from wherever it is seen, and the floor below a plate as well.
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, polished(Rgb(1.0)));
  for (int k = 0; k < 3; ++k) // upright, and seen by none of the floor's rays but a few
    add_polygon(
        scene, "post" + std::to_string(k),
        {{-1.0 + k, 0.02, 0}, {-0.99 + k, 0.02, 0}, {-0.99 + k, 0.03, 0}, {-1.0 + k, 0.03, 0}},
        double_sided(diffuse(0.0)));
  scene.background = Rgb(1.0);
  PassOneSettings settings = coarse();
  settings.form_factors.rays = 4096;
  const auto l = lit(scene, settings.mesh);
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  // Half of the sky, and the floor.
  // Which of 4096 rays are reflected is left to chance, for a part R of them.
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(mean_over(*l, solution.irradiance, "post" + std::to_string(k)).g / std::numbers::pi,
                1.0, 0.005);
  EXPECT_NEAR(mean_over(*l, solution.irradiance, "floor").g / std::numbers::pi, 1.0, 0.002);
}

/// A closed room of two metres with a polished floor, and a lamp that shines on it alone.
Scene polished_room() {
  Scene scene;
  const Material grey = diffuse(0.6);
  add_room(scene, {0, 0, 0}, {2, 2, 2},
           {diffuse(Rgb(0.7, 0.2, 0.2)), diffuse(Rgb(0.2, 0.7, 0.2)), polished(Rgb(0.3, 0.2, 0.1)),
            grey, grey, grey});
  add_polygon(scene, "lamp", {{0.7, 1.2, 0.7}, {1.3, 1.2, 0.7}, {1.3, 1.2, 1.3}, {0.7, 1.2, 1.3}},
              diffuse(Rgb(0.0), Rgb(10.0)));
  return scene;
}

/// Of the walls' means over 64 elements of 256 rays each.
constexpr double sampling = 0.02;

TEST(PolishedFloor, EveryTransportFindsTheSame) {
  PassOneSettings settings = coarse();
  const Solved by_rows = solved(polished_room(), settings);
  EXPECT_LT(by_rows.solution.closure.max_error, 1e-5);
  // Nothing is lost in the coat, nor elsewhere but in the walls.
  EXPECT_LT(std::abs(by_rows.solution.energy.imbalance), 0.02);
  EXPECT_NEAR(by_rows.solution.energy.mirror_absorbed.g, 0.0,
              0.005 * by_rows.solution.energy.emitted.g);
  settings.form_factors.method = FormFactorMethod::hemicube;
  expect_alike(by_rows, solved(polished_room(), settings), sampling);
  settings.form_factors.method = FormFactorMethod::rays;
  settings.solver.method = SolverMethod::progressive;
  expect_alike(by_rows, solved(polished_room(), settings, true), sampling);
  settings.cut = MeshCut::hierarchical;
  expect_alike(by_rows, solved(polished_room(), settings), sampling);
}

TEST(PolishedFloor, IsLeftToRaysBeyondTheWorlds) {
  PassOneSettings settings = coarse();
  const Solved by_images = solved(polished_room(), settings);
  settings.plan.worlds.max_depth = 0;
  settings.form_factors.rays = 2048;
  expect_alike(by_images, solved(polished_room(), settings), sampling);
  settings.solver.method = SolverMethod::progressive;
  expect_alike(by_images, solved(polished_room(), settings, true), sampling);

  // What the survey for shots finds of emission by way
  // of coats is worth all of the rays that are asked for.
  const auto l = lit(polished_room(), settings.mesh, settings.plan);
  const HemisphereSurvey survey = survey_hemispheres(*l->light, settings.form_factors, {});
  EXPECT_GE(survey.rays_traced, 2048 * element_count(l->mesh));
}

TEST(PolishedFloor, BringsLittleLightByManyRaysBeyondTheWorlds) {
  // A lamp that few rays found, each with all of its light, were a blot on the wall.
  PlanSettings plan;
  plan.worlds.max_depth = 0;
  const auto l = lit(polished_room(), coarse().mesh, plan);
  const HemisphereSamples net = make_direction_net(256);
  const std::vector<std::size_t> floor = elements_of(*l, "y0");
  GatherWorkspace work;
  double on_floor = 0.0, beyond = 0.0, light = 0.0;
  for (const std::size_t e : elements_of(*l, "y1")) {
    gather_rays(*l->light, net, receiver_of(*l->light, static_cast<ElementId>(e)),
                hash(static_cast<std::uint32_t>(e), 3), {}, work);
    for (const ElementHit& landing : work.result.landings) {
      const bool is_beyond = landing.world == none<WorldId>;
      beyond += is_beyond ? 1.0 : 0.0;
      light += is_beyond ? double{landing.light.g} : 0.0;
      on_floor += !is_beyond && std::ranges::count(floor, landing.element) > 0 ? 1.0 : 0.0;
    }
  }
  // All that meet the floor go on, and end on a wall but for a few on the lamp's black back;
  // R is least straight up.
  EXPECT_GT(beyond, 0.9 * on_floor);
  EXPECT_GT(light, 0.04 * beyond);
  EXPECT_LT(light, 0.15 * beyond);
}

TEST(PolishedFloor, HasWorldsByLargePlanesAlone) {
  // A table top of one square metre in a room of 24, and its edges of a fiftieth each.
  Scene scene = polished_room();
  add_box(scene, "table", {0.4, 0.5, 0.4}, {1.4, 0.52, 1.4}, diffuse(0.5));
  const std::size_t table = scene.materials.size() - 6;
  for (Triangle& triangle : scene.triangles)
    if (index(triangle.material) > table)
      triangle.material = static_cast<MaterialId>(table);
  scene.materials[table] = polished(Rgb(0.4));
  const auto l = lit(scene, coarse().mesh);
  // Floor, table top and its lower side.
  EXPECT_EQ(l->plan.mirrors.mirrors.size(), 3U);
  EXPECT_EQ(l->plan.mirrors.facets, 4U);
  // Rays find what the edges throw.
  const RadiositySolution solution = solve_pass_one(l->light, coarse());
  EXPECT_LT(std::abs(solution.energy.imbalance), 0.02);
}

} // namespace
} // namespace meninas::test
