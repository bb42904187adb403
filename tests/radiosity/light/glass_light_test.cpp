// Light through solids of glass in pass one:
// bent by closed forms, owned once, closed, and never without an end.
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/queries/gltf_node_factors.h"
#include "radiosity/pass_one.h"
#include "radiosity/light/glass_light.h"
#include "scenes/materials/glass.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/coats.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/globes.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Receiver on_floor(const LitScene& lit, const Point3& x) {
  const MeshSide& floor =
      lit.mesh.sides[index(lit.mesh.side_of_element[elements_of(lit, "floor")[0]])];
  return {x, floor.normal, floor.plane_class};
}

/// A black floor, wide enough that the lamp is less than half of all,
/// and a lamp of `edge` metres that glows with E = 1, `height` above its origin.
Scene floor_and_lamp(double height, double edge) {
  Scene scene;
  const double w = 3.0 + edge;
  add_polygon(scene, "floor", {{-w, 0, w}, {w, 0, w}, {w, 0, -w}, {-w, 0, -w}}, diffuse(0.0));
  const double e = 0.5 * edge;
  add_polygon(scene, "lamp", {{-e, height, -e}, {e, height, -e}, {e, height, e}, {-e, height, e}},
              diffuse(0.0, 1.0));
  return scene;
}

/// On the floor's middle, in a scene with elements of that size.
ArrivingLight arriving_in_the_middle(Scene scene, double element_size, int rays) {
  const auto room = lit(std::move(scene), {.element_size = element_size});
  DirectSettings settings;
  settings.solid_rays = rays;
  DirectWorkspace work;
  return direct_irradiance(*room->light, on_floor(*room, {0, 0, 0}), settings, 7, work);
}

TEST(SolidLight, AThickSlabBringsALampNearer) {
  // Under a slab of thickness d all rays come from an image that is nearer by d - d tan b / tan a,
  // sin a = n sin b: by d (1 - 1 / n) near the normal.
  // Radiance is what it was, but for the faces: H = T E A / (pi h'^2).
  constexpr double height = 2.0, thickness = 1.0, ior = 1.5, edge = 0.2;
  Scene scene = floor_and_lamp(height, edge);
  // So wide that nothing arrives by total reflection at its sides.
  add_box(scene, "slab", {-60, 0.5, -60}, {60, 0.5 + thickness, 60}, solid_glass(Rgb(1.0), ior));
  const ArrivingLight found = arriving_in_the_middle(std::move(scene), 1.0, 1 << 18);
  const double nearer = height - thickness * (1.0 - 1.0 / ior);
  const double expected = pane_transmittance(ior, 1.0) * edge * edge / (pi * nearer * nearer);
  // Some thousand rays find the lamp;
  // it is seen under 3 degrees to either side, for which the closed form is true to 0.5 %.
  EXPECT_NEAR(found.total.g, expected, 0.02 * expected);
  // What goes to and fro between the faces before it comes out is some F^2 of it.
  EXPECT_LT(found.mirrored.g, 0.02 * expected);
}

TEST(SolidLight, WhatASolidTakesGoesByTheMetre) {
  // A small lamp straight above:
  // H goes by a^d, d the thickness of a metre, which leaves a half of red.
  Scene scene = floor_and_lamp(2.0, 0.04);
  Material amber = solid_glass(Rgb(1.0));
  amber.attenuation_color = Rgb(0.5, 0.25, 1.0);
  amber.attenuation_distance = 1.0;
  add_box(scene, "slab", {-60, 0.5, -60}, {60, 1.5, 60}, amber);
  const Rgb found = arriving_in_the_middle(std::move(scene), 1.0, 1 << 16).total;
  ASSERT_GT(found.b, 0.0);
  // F^2 of the light passes thrice: 0.0016 of it less beside less attenuation.
  EXPECT_NEAR(found.r / found.b, 0.5, 2e-3);
  EXPECT_NEAR(found.g / found.b, 0.25, 2e-3);
}

TEST(SolidLight, ASlabIsAPaneOfTwoFacesToDiffuseLight) {
  // Wide and thin beside the room, whose ceiling glows:
  // of what comes evenly from above T arrives below, with T the mean of a pane's.
  Scene scene = floor_and_lamp(1.0, 40.0);
  add_box(scene, "slab", {-60, 0.45, -60}, {60, 0.5, 60}, solid_glass(Rgb(1.0)));
  const Rgb found = arriving_in_the_middle(std::move(scene), 20.0, 1 << 13).total;
  double passed = 0.0;
  // As far as the lamp reaches: to sin = 20 / sqrt(401).
  constexpr int steps = 4000;
  for (int k = 0; k < steps; ++k) {
    const double sine2 = (k + 0.5) / steps;
    if (std::sqrt(sine2) < 20.0 / std::sqrt(401.0))
      passed += pane_transmittance(1.5, std::sqrt(1.0 - sine2)) / steps;
  }
  EXPECT_NEAR(found.g, passed, 0.01 * passed);
}

/// The share of parallel light from above that reaches the plane a distance
/// h below the middle of a ball of glass between the rings of radii a and b:
/// rays that enter at r sin t are turned towards the axis by 2 (t - t'),
/// n sin t' = sin t, and lose what is reflected on the way in and out (Fresnel).
double through_ball(double r, double h, double a, double b) {
  constexpr int steps = 200'000;
  constexpr double n = 1.5;
  double power = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double sine = (k + 0.5) / steps, in = std::asin(sine), inside = std::asin(sine / n);
    const double leaves = in + pi - 2.0 * inside, turned = 2.0 * (in - inside);
    if (std::cos(turned) <= 0.0)
      continue;
    const double fall = (h + r * std::cos(leaves)) / std::cos(turned);
    const double at = std::abs(r * std::sin(leaves) - fall * std::sin(turned));
    if (at > a && at < b)
      power += 2.0 * sine / steps * std::pow(1.0 - fresnel(n, std::cos(in)), 2.0);
  }
  return power * r * r / (b * b - a * a);
}

// A ball of glass collects light 1.5 r from its middle (n r / (2 (n - 1)))
// and takes it from its shadow, where a tenth is left: light that is turned far.
// (Sheets would leave more than 0.8.) The lamp is small and far away:
// some 170 of the million rays find it, so that the mean over the ring is 8 % off.
TEST(SolidLight, ABallCollectsLightAndLeavesAShadow) {
  constexpr double r = 0.2, h = 0.3, inner = 0.12, outer = 0.185;
  Scene scene = floor_and_lamp(40.0, 2.0);
  add_globe(scene, "ball", {.centre = {0, h, 0}, .radius = r, .meridians = 128, .parallels = 64}, solid_glass(Rgb(1.0)));
  const auto room = lit(std::move(scene), {.element_size = 1.0});
  DirectSettings settings;
  settings.solid_rays = 1 << 14;
  DirectWorkspace work;
  const auto at = [&](double x, double z, std::uint32_t seed) {
    return direct_irradiance(*room->light, on_floor(*room, {x, 0, z}), settings, seed, work)
        .total.g;
  };
  const double without = 2.0 * 2.0 / (pi * 40.0 * 40.0);
  double ring = 0.0;
  constexpr int points = 64;
  for (std::uint32_t k = 0; k < points; ++k) {
    const auto sample = sobol4(k, 0);
    const double radius =
                     std::sqrt(inner * inner + (outer * outer - inner * inner) * double{sample[0]}),
                 turn = 2.0 * pi * double{sample[1]};
    ring += at(radius * std::cos(turn), radius * std::sin(turn), k) / points;
  }
  EXPECT_GT(at(0.0, 0.0, 7), 10.0 * without);
  EXPECT_NEAR(ring / without, through_ball(r, h, inner, outer),
              4.0 * 0.08 * through_ball(r, h, inner, outer));
  EXPECT_NEAR(at(1.5, 0.0, 7), without, 0.05 * without);
}

/// A closed room with a lamp, and an amber block and a ball in it.
Scene room_of_solids() {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  add_polygon(scene, "lamp", {{0.6, 1.9, 1.4}, {1.0, 1.9, 1.4}, {1.0, 1.9, 1.0}, {0.6, 1.9, 1.0}},
              double_sided(diffuse(0.0, 10.0)));
  Material amber = solid_glass({1.0, 0.9, 0.8});
  amber.attenuation_color = {0.8, 0.5, 0.2};
  amber.attenuation_distance = 0.5;
  add_box(scene, "block", {0.3, 0.05, 0.6}, {0.8, 0.8, 1.2}, amber);
  add_globe(scene, "ball", {.centre = {1.4, 0.5, 0.9}, .radius = 0.35}, solid_glass(Rgb(1.0)));
  return scene;
}

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.25;
  settings.form_factors.rays = 256;
  settings.interpolation.method = Interpolation::average;
  settings.solver.tolerance = 1e-4;
  return settings;
}

TEST(SolidLight, RowsCloseAndEnergyIsAccountedFor) {
  const PassOneSettings settings = coarse();
  const auto room = lit(room_of_solids(), settings.mesh, settings.plan);
  const RadiositySolution solution = solve_pass_one(room->light, settings);
  EXPECT_LT(solution.closure.max_error, 1e-5);
  EXPECT_LT(std::abs(solution.energy.imbalance), 0.02);
  EXPECT_EQ(solution.energy.escaped, Rgb(0.0));
  // The block takes most of blue and least of red.
  EXPECT_GT(solution.energy.mirror_absorbed.b, solution.energy.mirror_absorbed.g);
  EXPECT_GT(solution.energy.mirror_absorbed.g, solution.energy.mirror_absorbed.r);
  EXPECT_GT(solution.energy.mirror_absorbed.r, 0.0);
}

TEST(SolidLight, AWhiteFurnaceStaysWhite) {
  Scene scene = furnace(0.5, {}, Point3(2.0));
  add_globe(scene, "ball", {.centre = {1.0, 0.8, 1.1}, .radius = 0.5, .meridians = 20, .parallels = 10}, solid_glass(Rgb(1.0)));
  add_box(scene, "block", {0.1, 0.2, 0.1}, {0.4, 1.2, 0.6}, solid_glass(Rgb(1.0), 2.4));
  PassOneSettings settings = coarse();
  const auto room = lit(std::move(scene), settings.mesh, settings.plan);
  const RadiositySolution solution = solve_pass_one(room->light, settings);
  for (const char* wall : {"x0", "y0", "z1"})
    for (const std::size_t e : elements_of(*room, wall))
      for (int band = 0; band < 3; ++band)
        EXPECT_NEAR(solution.radiosity[e][band], 2.0, 1e-3) << wall;
}

TEST(SolidLight, OpenNestedAndTrappingSolidsEnd) {
  Scene scene = room_of_solids();
  // A sheet that is the surface of nothing, a block in the block,
  // and a wall from which light enters a solid that it cannot leave but by chance.
  add_polygon(scene, "open", {{0.1, 0.3, 1.6}, {1.9, 0.3, 1.6}, {1.9, 1.6, 1.7}, {0.1, 1.6, 1.7}},
              solid_glass(Rgb(1.0)));
  add_box(scene, "inner", {0.4, 0.2, 0.7}, {0.7, 0.7, 1.0}, solid_glass(Rgb(1.0), 2.0));
  add_box(scene, "thing", {1.3, 0.4, 0.8}, {1.5, 0.6, 1.0}, diffuse(0.5, 1.0));
  add_box(scene, "outward", {1.2, 1.2, 0.2}, {1.6, 1.6, 0.5}, solid_glass(Rgb(1.0), 0.0));
  const PassOneSettings settings = coarse();
  const auto room = lit(std::move(scene), settings.mesh, settings.plan);
  const RadiositySolution solution = solve_pass_one(room->light, settings);
  EXPECT_LT(solution.closure.max_error, 1e-5);
  for (const Rgb& b : solution.radiosity)
    for (int band = 0; band < 3; ++band)
      EXPECT_TRUE(std::isfinite(b[band]) && b[band] >= 0.0);
}

TEST(SolidLight, FormFactorsThroughASlabAreThoseThroughAPane) {
  const auto floor_to_lamp = [](const Material& between, double thickness) {
    Scene scene = floor_and_lamp(1.0, 1.5);
    if (thickness > 0.0)
      add_box(scene, "slab", {-60, 0.5, -60}, {60, 0.5 + thickness, 60}, between);
    else
      add_polygon(scene, "pane", {{-60, 0.5, 60}, {60, 0.5, 60}, {60, 0.5, -60}, {-60, 0.5, -60}},
                  between);
    NodeFactorSettings settings;
    settings.method = NodeFactorMethod::rays;
    settings.rays = 1 << 18;
    const std::array lamp{NodeSet{NodeId{1}}};
    return node_form_factors(scene, find_surfaces(scene), {NodeId{0}}, lamp, settings)
        .to[0]
        .total.value;
  };
  // Thin enough to shift nothing: a thousandth of the distance.
  const double pane = floor_to_lamp(glass(Rgb(1.0)), 0.0);
  EXPECT_NEAR(floor_to_lamp(solid_glass(Rgb(1.0)), 1e-3), pane, 0.01 * pane);
}

TEST(SolidLight, ManySolidsAreFewBodies) {
  Scene scene = floor_and_lamp(3.0, 1.0);
  for (int k = 0; k < 40; ++k)
    add_box(scene, "bead", {-2.0 + 0.1 * k, 0.2, 0.0}, {-1.95 + 0.1 * k, 0.25, 0.05},
            solid_glass(Rgb(1.0)));
  const auto room = lit(std::move(scene), {.element_size = 1.0});
  const SolidBodies& solids = room->light->solids;
  EXPECT_EQ(solids.bodies.size(), max_bodies);
  const RayFrame& frame = room->light->rays.frame();
  for (std::uint32_t t = 0; t < room->scene.triangles.size(); ++t) {
    const bool solid = is_solid_glass(material_of(room->scene, TriangleId{t}));
    ASSERT_EQ(solids.body_of_triangle[t] != SolidBodies::no_body, solid);
    if (!solid)
      continue;
    const SolidBody& body = solids.bodies[solids.body_of_triangle[t]];
    for (const VertexId v : room->scene.triangles[t].vertices) {
      const Point3 p = (position(room->scene, v) - frame.centre) * frame.scale;
      EXPECT_LE(glm::length(p - body.centre), body.radius * (1.0 + 1e-9));
    }
    EXPECT_LT(body.radius / frame.scale, 0.25);
  }
}

TEST(SolidLight, ACoatInGlassIsTheMirrorThere) {
  // Of a coat that reflects all:
  // what the glass takes on the way to it is gone, as it is with a mirror.
  const auto walls_lit = [](const Material& plate) {
    Scene scene = room_of_solids();
    // Last, so that the elements of all else have the same numbers.
    add_polygon(scene, "plate",
                {{0.35, 0.3, 1.15}, {0.75, 0.3, 1.15}, {0.75, 0.3, 0.65}, {0.35, 0.3, 0.65}},
                plate);
    const auto room = lit(std::move(scene), coarse().mesh);
    const RadiositySolution solution = solve_pass_one(room->light, coarse());
    return mean_over(*room, solution.irradiance, "y1").b;
  };
  Material coat = polished(Rgb(0.5));
  coat.ior = 0.0;
  const double wanted = walls_lit(mirror(1.0));
  EXPECT_NEAR(walls_lit(coat), wanted, 1e-4 * wanted);
}

} // namespace
} // namespace meninas::test
