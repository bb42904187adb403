// Light of a sky that depends on direction, as pass one finds it: on open ground, and through windows.
#include "form_factors/point_form_factor.h"
#include "radiosity/light/direct_irradiance.h"
#include "scenes/errors.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/skies.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Scene open_floor(double reflectance = 0.0) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, diffuse(reflectance));
  return scene;
}

PassOneSettings with_rays(int rays) {
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  return settings;
}

/// The mean irradiance at the vertices of the scene's first surface.
Rgb mean_irradiance(const Scene& scene, const PassOneSettings& settings) {
  const auto l = lit(scene, {.element_size = 0.5});
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  return mean_over(*l, solution.irradiance, scene.nodes[0].name);
}

TEST(SkyLight, OpenGroundReceivesTheIntegralOfItsHemisphere) {
  Scene scene = open_floor();
  // Integrals of L cos over the hemisphere: of cos 2 pi / 3; of the half where x > 0 pi / 2.
  scene.background = sky_of([](const Direction& d) { return Rgb(std::max(0.0, d.y)); });
  EXPECT_NEAR(mean_irradiance(scene, with_rays(1024)).g, 2.0 * pi / 3.0, 0.005);
  scene.background = sky_of([](const Direction& d) { return Rgb(d.x > 0.0 ? 1.0 : 0.0); });
  EXPECT_NEAR(mean_irradiance(scene, with_rays(1024)).g, 0.5 * pi, 0.01);
}

TEST(SkyLight, EverySolverGathersIt) {
  Scene scene = open_floor(0.5);
  scene.background = sky_of([](const Direction& d) { return Rgb(std::max(0.0, d.y), 1.0, 0.0); });
  PassOneSettings settings = with_rays(1024);
  for (const FormFactorMethod method : {FormFactorMethod::rays, FormFactorMethod::hemicube})
    for (const SolverMethod solver : {SolverMethod::bicgstab, SolverMethod::progressive})
      for (const MeshCut mesh : {MeshCut::uniform, MeshCut::hierarchical}) {
        if (mesh == MeshCut::hierarchical && (method == FormFactorMethod::hemicube || solver == SolverMethod::progressive))
          continue;
        settings.form_factors.method = method;
        settings.solver.method = solver;
        settings.cut = mesh;
        const auto l = lit(scene, {.element_size = 0.5});
        const RadiositySolution solution = solve_pass_one(l->light, settings);
        for (const auto& h : solution.field.irradiance) {
          EXPECT_NEAR(h.r, 2.0 * pi / 3.0, 0.02);
          EXPECT_NEAR(h.g, pi, 0.01);
        }
        // Solvers stop at 1e-4 of the light.
        EXPECT_NEAR(solution.energy.imbalance, 0.0, 1e-4);
      }
}

TEST(SkyLight, AnalyticFormFactorsRefuseAnUnevenSky) {
  Scene scene = open_floor();
  scene.background = sky_of([](const Direction& d) { return Rgb(std::max(0.0, d.y)); });
  PassOneSettings settings = with_rays(64);
  settings.form_factors.method = FormFactorMethod::analytic;
  const auto l = lit(scene, {.element_size = 0.5});
  EXPECT_THROW(solve_pass_one(l->light, settings), UsageError);
}

TEST(SkyLight, AnEvenMapIsTheBackgroundOfThatRadiance) {
  const Rgb radiance(0.5, 1.0, 2.0);
  for (const bool room : {false, true}) {
    Scene scene = room ? room_with_window(diffuse(0.6)) : open_floor(0.5);
    if (!room)
      add_box(scene, "box", {0.2, 0.0, 0.2}, {0.5, 0.4, 0.6}, diffuse(0.7));
    const auto solved = [&](const Environment& sky) {
      scene.background = sky;
      const auto l = lit(scene, {.element_size = 0.5});
      return solve_pass_one(l->light, with_rays(256)).field.irradiance;
    };
    const auto even = solved(radiance), map = solved(sky_of([&](const Direction&) { return radiance; }));
    ASSERT_EQ(even.size(), map.size());
    for (std::size_t v = 0; v < even.size(); ++v)
      EXPECT_LE(glm::distance(even[v], map[v]), 1e-4F * (0.01F + glm::length(even[v]))) << room;
  }
}

TEST(SkyLight, AWhiteFurnaceStaysWhite) {
  // Under the same radiance from everywhere, what absorbs nothing is as bright.
  Scene scene = open_floor(1.0);
  add_box(scene, "box", {0.2, 0.1, 0.2}, {0.5, 0.4, 0.6}, diffuse(1.0));
  scene.background = sky_of([](const Direction&) { return Rgb(1.0); });
  const auto l = lit(scene, {.element_size = 0.25});
  const RadiositySolution solution = solve_pass_one(l->light, with_rays(256));
  const Rgb floor = mean_over(*l, solution.irradiance, "floor");
  EXPECT_NEAR(floor.g, pi, 2e-3);
  EXPECT_NEAR(mean_over(*l, solution.irradiance, "box.y1").g, pi, 2e-3);
}

TEST(SkyLight, MirrorsShowTheSkyThatTheyFace) {
  // At the foot of an endless mirror facing east: half of the hemisphere is the eastern sky, straight,
  // and half its image.
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 1}, {1e-3, 0, 1}, {1e-3, 0, -1}, {0, 0, -1}}, diffuse(0.0));
  add_polygon(scene, "mirror", {{0, 0, 1e3}, {0, 0, -1e3}, {0, 1e3, -1e3}, {0, 1e3, 1e3}},
              mirror(0.9));
  scene.background = sky_of([](const Direction& d) { return Rgb(d.x > 0.0 ? 1.0 : 0.0, 1.0, d.x < 0.0 ? 1.0 : 0.0); });
  const auto l = lit(scene, {.element_size = 1.0});
  const RadiositySolution solution = solve_pass_one(l->light, with_rays(1024));
  for (std::size_t v = 0; v < solution.field.irradiance.size(); ++v) {
    EXPECT_NEAR(solution.field.irradiance[v].r, 0.5 * 1.9 * pi, 0.02);
    EXPECT_NEAR(solution.field.irradiance[v].g, 0.5 * 1.9 * pi, 0.01);
    EXPECT_NEAR(solution.field.irradiance[v].b, 0.0, 0.02);
    EXPECT_NEAR(solution.field.mirrored[v].r, 0.5 * 0.9 * pi, 0.02);
  }
}

TEST(SkyLight, ASmallSunOfAPictureIsDirectLight) {
  Scene scene = open_floor();
  const Direction sun = glm::normalize(Vec3(0.4, 0.8, 0.2));
  scene.background = sky_of(
      [&](const Direction& d) { return Rgb(glm::dot(d, sun) > std::cos(0.01) ? 2e4 : 1.0); }, 2048);
  const RadianceMap& map = *scene.background.map;
  ASSERT_EQ(map.suns.size(), 1U);
  const double expected = pi + map.suns[0].irradiance.g * sun.y;
  // All but what the texels at the sun's place keep: the cap of about a hundred over 3e-4 sr.
  EXPECT_NEAR(mean_irradiance(scene, with_rays(256)).g, expected, 0.02 * expected);
}

// --- Windows

const std::vector<Point3> window{{4, 1, 1.5}, {4, 1, 2.9}, {4, 2.2, 2.9}, {4, 2.2, 1.5}};

/// Vertices there are the floor's alone.
bool is_inside_floor(const Point3& x) {
  return x.y == 0.0 && x.x > 0.1 && x.x < 3.9 && x.z > 0.1 && x.z < 4.9;
}

/// D at a point of the room, and no more.
ArrivingLight arriving(const LitScene& l, const Point3& x, const Direction& normal) {
  DirectWorkspace work;
  DirectSettings settings;
  settings.shadow_rays = settings.penumbra_rays = 1024;
  return direct_irradiance(*l.light, {x, normal, none<PlaneId>, Vec3(0.0)}, settings, 0, work);
}

TEST(SkyPortals, AnOpeningInAWallIsFoundAndOwnsItsLight) {
  Scene scene = room_with_window(diffuse(0.0));
  scene.background = Rgb(2.0);
  const auto l = lit(scene, {.element_size = 0.5});
  ASSERT_EQ(l->light->portals.size(), 1U);
  EXPECT_NEAR(l->light->portals[0].area, 1.4 * 1.2, 1e-9);
  EXPECT_LT(l->light->portals[0].plane.normal.x, -0.999);
  const Point3 x{1.3, 1.0, 2.2};
  const double exact = 2.0 * pi * point_form_factor(x, {0, 1, 0}, window);
  EXPECT_NEAR(arriving(*l, x, {0, 1, 0}).total.g, exact, 1e-9);
  // What rays gather besides is nothing: walls are black, and the sky is the opening's.
  const RadiositySolution solution = solve_pass_one(l->light, with_rays(64));
  const ElementMesh& mesh = solution.field.mesh();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point3& at = mesh.vertices[v];
    if (!is_inside_floor(at))
      continue;
    const double here = 2.0 * pi * std::abs(point_form_factor(at, {0, 1, 0}, window));
    EXPECT_NEAR(solution.field.irradiance[v].g, here, 1e-3 * (0.01 + here)) << at.x << ' ' << at.z;
  }
}

TEST(SkyPortals, OpenScenesAndClosedRoomsHaveNone) {
  Scene open = open_floor(0.5);
  add_box(open, "box", {0.2, 0.0, 0.2}, {0.5, 0.4, 0.6}, diffuse(0.7));
  open.background = Rgb(1.0);
  EXPECT_TRUE(lit(open, {.element_size = 0.5})->light->portals.empty());
  Scene closed;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(closed, {0, 0, 0}, {1, 1, 1}, walls);
  closed.background = Rgb(1.0);
  EXPECT_TRUE(lit(closed, {.element_size = 0.5})->light->portals.empty());
  Scene night = room_with_window(diffuse(0.5));
  EXPECT_TRUE(lit(night, {.element_size = 0.5})->light->portals.empty());
}

/// The integral over the window of L(d) cos cos' / d^2 from a point that sees all of it.
double through_window(const Point3& x, const Direction& normal,
                      const std::function<double(const Direction&)>& radiance) {
  constexpr int steps = 400;
  double sum = 0.0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      const Point3 y{4.0, 1.0 + 1.2 * (j + 0.5) / steps, 1.5 + 1.4 * (i + 0.5) / steps};
      const double d2 = glm::dot(y - x, y - x);
      const Direction d = (y - x) / std::sqrt(d2);
      sum += radiance(d) * std::max(0.0, glm::dot(d, normal)) * d.x / d2;
    }
  return sum * 1.2 * 1.4 / (steps * steps);
}

TEST(SkyPortals, AWindowShowsEachPointItsPartOfTheSky) {
  const auto gradient = [](const Direction& d) { return 1.0 + 3.0 * std::max(0.0, d.y) + d.z; };
  Scene scene = room_with_window(diffuse(0.0));
  scene.background = sky_of([&](const Direction& d) { return Rgb(gradient(d)); });
  const auto l = lit(scene, {.element_size = 0.5});
  ASSERT_EQ(l->light->portals.size(), 1U);
  for (const Point3& x : {Point3(1.3, 0.05, 2.2), Point3(3.0, 0.2, 1.0), Point3(0.5, 0.1, 4.5)}) {
    const double exact = through_window(x, {0, 1, 0}, gradient);
    // A thousand low-discrepancy points on the window.
    EXPECT_NEAR(arriving(*l, x, {0, 1, 0}).total.g, exact, 2e-3 * exact);
  }
}

TEST(SkyPortals, HousesOutsideTakeTheirPart) {
  // A wall outside hides the lower half of the sky from a point at the height of its upper edge.
  const auto sky = [](const Direction&) { return 1.0; };
  Scene scene = room_with_window(diffuse(0.0));
  add_polygon(scene, "outside", {{6, -50, -50}, {6, -50, 50}, {6, 1.6, 50}, {6, 1.6, -50}}, diffuse(0.0));
  scene.background = Rgb(1.0);
  const auto l = lit(scene, {.element_size = 0.5});
  ASSERT_EQ(l->light->portals.size(), 1U);
  const Point3 x{2.0, 1.6, 2.2};
  const std::vector<Point3> upper{{4, 1.6, 1.5}, {4, 1.6, 2.9}, {4, 2.2, 2.9}, {4, 2.2, 1.5}};
  const double exact = pi * point_form_factor(x, {1, 0, 0}, upper);
  EXPECT_NEAR(arriving(*l, x, {1, 0, 0}).total.g, exact, 0.005 * exact);
  EXPECT_GT(through_window(x, {1, 0, 0}, sky), 1.8 * exact);
}

TEST(SkyPortals, MirrorsShowTheWindowAndItsSky) {
  // The wall x = 0 is a mirror: the window's image is at x = -4, its sky reflected.
  Scene scene = room_with_window(diffuse(0.0));
  scene.materials[0] = mirror(0.8);
  const auto gradient = [](const Direction& d) { return 1.0 + 3.0 * std::max(0.0, d.y) + d.z; };
  scene.background = sky_of([&](const Direction& d) { return Rgb(gradient(d)); });
  const auto l = lit(scene, {.element_size = 0.5});
  ASSERT_EQ(l->light->portals.size(), 1U);
  const Point3 x{1.3, 0.05, 2.2}, image{-1.3, 0.05, 2.2};
  const double straight = through_window(x, {0, 1, 0}, gradient);
  const double mirrored = 0.8 * through_window(image, {0, 1, 0}, gradient);
  const ArrivingLight light = arriving(*l, x, {0, 1, 0});
  EXPECT_NEAR(light.mirrored.g, mirrored, 3e-3 * mirrored);
  EXPECT_NEAR(light.total.g, straight + mirrored, 3e-3 * (straight + mirrored));
}

TEST(SkyPortals, APanePassesWhatItsAngleLetsThrough) {
  const Material clear = double_sided(glass(Rgb(1.0)));
  Scene scene = room_with_window(diffuse(0.0), &clear);
  scene.background = Rgb(1.0);
  const auto l = lit(scene, {.element_size = 0.5});
  ASSERT_EQ(l->light->portals.size(), 1U);
  const Point3 x{1.3, 0.05, 2.2};
  const double exact = through_window(x, {0, 1, 0}, [](const Direction& d) { return pane_transmittance(1.5, d.x); });
  EXPECT_NEAR(arriving(*l, x, {0, 1, 0}).total.g, exact, 0.01 * exact);
  const RadiositySolution solution = solve_pass_one(l->light, with_rays(256));
  const ElementMesh& mesh = solution.field.mesh();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (is_inside_floor(mesh.vertices[v]) && mesh.vertices[v].x < 3.0) {
      const double here = through_window(mesh.vertices[v], {0, 1, 0}, [](const Direction& d) {
        return pane_transmittance(1.5, d.x);
      });
      EXPECT_NEAR(solution.field.irradiance[v].g, here, 0.02 * here + 1e-3);
    }
}

TEST(SkyPortals, WhatIsOutsideTakesItsPartOnce) {
  // Rays of the form factors set out again behind what they pass outside the window: its light is still the window's.
  Material veil = double_sided(diffuse(0.0));
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha = 0.5;
  veil.transmission = 0.5;
  const Material pane = double_sided(glass(Rgb(0.5), 1.0)); // reflects nothing
  for (const Material* outside : std::initializer_list<const Material*>{&veil, &pane}) {
    Scene scene = room_with_window(diffuse(0.0));
    add_polygon(scene, "outside", {{5, -90, -90}, {5, -90, 90}, {5, 90, 90}, {5, 90, -90}}, *outside);
    scene.background = Rgb(1.0);
    const auto l = lit(scene, {.element_size = 0.5});
    ASSERT_EQ(l->light->portals.size(), 1U);
    const RadiositySolution solution = solve_pass_one(l->light, with_rays(64));
    const ElementMesh& mesh = solution.field.mesh();
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (!is_inside_floor(mesh.vertices[v]))
        continue;
      const double here = through_window(mesh.vertices[v], {0, 1, 0}, [&](const Direction& d) {
        return d.x > 0.0 ? 0.5 : 0.0;
      });
      // By some tens of shadow rays.
      EXPECT_NEAR(solution.field.irradiance[v].g, here, 0.03 * here + 1e-3)
          << (outside == &veil ? "veil " : "pane ") << mesh.vertices[v].x << " " << mesh.vertices[v].z;
    }
  }
}

/// Walls of `sides` faces about the y axis, a floor, and a ceiling with a round hole.
Scene drum(double radius, double height, double hole, int sides) {
  Scene scene;
  const auto on = [&](double r, double y, int k) {
    const double phi = -2.0 * pi * k / sides;
    return Point3(r * std::cos(phi), y, r * std::sin(phi));
  };
  for (int k = 0; k < sides; ++k) {
    const Material black = double_sided(diffuse(0.0));
    add_polygon(scene, "wall", {on(radius, 0, k), on(radius, 0, k + 1), on(radius, height, k + 1), on(radius, height, k)}, black);
    add_polygon(scene, "floor", {on(radius, 0, k + 1), on(radius, 0, k), {0, 0, 0}}, black);
    add_polygon(scene, "ceiling", {on(radius, height, k), on(radius, height, k + 1), on(hole, height, k + 1), on(hole, height, k)}, black);
  }
  scene.background = Rgb(1.0);
  return scene;
}

TEST(SkyPortals, ARoundOpeningIsAFewPolygons) {
  constexpr int sides = 96;
  const auto l = lit(drum(3.0, 3.0, 0.5, sides), {.element_size = 3.0});
  EXPECT_EQ(l->light->portals.size(), 4U) << "of 32 corners at most";
  double area = 0.0;
  for (const SkyPortal& portal : l->light->portals)
    area += portal.area;
  EXPECT_NEAR(area, 0.5 * sides * 0.25 * std::sin(2.0 * pi / sides), 1e-12);
}

TEST(SkyPortals, BoardsOutsideHideNoWindow) {
  Scene scene = room_with_window(diffuse(0.0));
  for (int k = 0; k < 300; ++k) {
    const double x = 10.0 + 3.0 * (k % 20), z = -30.0 + 3.0 * (k / 20);
    add_polygon(scene, "board", {{x, 0, z}, {x, 0, z + 2}, {x, 2, z + 2}, {x, 2, z}},
                double_sided(diffuse(0.5)));
  }
  scene.background = Rgb(1.0);
  EXPECT_EQ(lit(scene, {.element_size = 3.0})->light->portals.size(), 1U);
}

TEST(SkyPortals, APaneByItselfIsOneEmitter) {
  Scene scene = room_with_window(diffuse(0.0));
  add_polygon(scene, "pane", {{4.02, 0.9, 1.4}, {4.02, 0.9, 3.0}, {4.02, 2.3, 3.0}, {4.02, 2.3, 1.4}},
              double_sided(glass(Rgb(1.0))));
  scene.background = Rgb(1.0);
  const auto l = lit(scene, {.element_size = 3.0});
  // The hole in front of it is another: some light passes beside the pane.
  std::size_t in_its_plane = 0;
  for (const SkyPortal& portal : l->light->portals)
    in_its_plane += std::abs(portal.plane.normal.x * 4.02 - portal.plane.offset) < 1e-9 ? 1 : 0;
  EXPECT_EQ(in_its_plane, 1U);
}

TEST(SkyPortals, TheMouthOfAPotIsNone) {
  // What it lights is lit by a large part of the sky, which rays find.
  EXPECT_TRUE(lit(drum(0.5, 0.5, 0.4, 12), {.element_size = 1.0})->light->portals.empty());
}

TEST(SkyPortals, EnergyIsBalancedAndBitsAreTheSameForAnyThreadCount) {
  Scene scene = room_with_window(diffuse(0.6));
  scene.background = sky_of([](const Direction& d) { return Rgb(1.0 + d.y, 1.0, 1.0 - d.y); });
  std::vector<RadiositySolution> solutions;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const auto l = lit(scene, {.element_size = 0.5});
    solutions.push_back(solve_pass_one(l->light, with_rays(256)));
  }
  EXPECT_EQ(solutions[0].field.irradiance, solutions[1].field.irradiance);
  // What enters by the window is told by rays, of which 256 an element meet it, and not by its closed form.
  EXPECT_NEAR(solutions[0].energy.imbalance, 0.0, 0.03);
}

} // namespace
} // namespace meninas::test
