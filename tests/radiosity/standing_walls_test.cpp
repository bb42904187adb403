// Elements across which walls stand: divided where light would leak, and nowhere else.
#include "radiosity/mesh_division.h"
#include "radiosity/standing_walls.h"
#include "radiosity/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

ElementMesh divided(const LitScene& l, const MeshSettings& settings = {}) {
  return divide_under_walls(l.mesh, l.scene, l.surfaces, *l.rays, {}, settings);
}

std::vector<Point3> turned(const std::vector<Point3>& corners) {
  return {corners.rbegin(), corners.rend()};
}

// --- Light

enum class Wall { sheet, body };
constexpr double wall_x = 2.2, reflectance = 0.7;
constexpr Point3 room_size{4.0, 2.4, 3.0};

/// A room with a lamp at its left, which a wall divides: no light comes to its right.
Scene two_rooms(Wall wall) {
  Scene scene;
  const Material plaster = diffuse(reflectance);
  add_room(scene, Point3(0.0), room_size, {plaster, plaster, plaster, plaster, plaster, plaster});
  add_polygon(scene, "lamp", {{0.5, 2.3, 1}, {1.5, 2.3, 1}, {1.5, 2.3, 2}, {0.5, 2.3, 2}},
              diffuse(0.0, 10.0));
  const auto across = [](double x) {
    return std::vector<Point3>{{x, 0, 0}, {x, 0, 3}, {x, 2.4, 3}, {x, 2.4, 0}};
  };
  if (wall == Wall::sheet) {
    add_polygon(scene, "wall", across(wall_x), double_sided(plaster));
  } else {
    add_polygon(scene, "wall", across(wall_x - 0.01), plaster);
    add_polygon(scene, "wall", turned(across(wall_x + 0.01)), plaster);
  }
  return scene;
}

/// The mean irradiance of what is right of the wall,
/// and the largest radiosity left of it, lamps aside.
struct BothSides {
  double dark = 0.0, lit = 0.0;
};
BothSides light_of(Wall wall, double size, bool divide) {
  const auto l = lit(two_rooms(wall), {.element_size = size});
  if (divide)
    l->mesh = divided(*l);
  l->light.emplace(
      make_light_scene(l->scene, l->surfaces, *l->rays, l->plan.mirrors, l->plan.worlds, l->mesh));
  PassOneSettings settings;
  settings.form_factors.rays = 256;
  settings.interpolation.method = Interpolation::average;
  const RadiositySolution solution = solve_pass_one(*l->light, settings);
  BothSides light;
  double area = 0.0;
  for (std::size_t e = 0; e < element_count(l->mesh); ++e) {
    const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[e])];
    const double x = centre_of(l->mesh, static_cast<ElementId>(e)).x;
    const bool in_wall = std::abs(side.normal.x) > 0.5 && std::abs(x - wall_x) < 0.1;
    if (in_wall ? side.normal.x > 0.0 : x > wall_x) {
      area += l->mesh.area[e];
      light.dark += l->mesh.area[e] * solution.irradiance[e].g;
    } else if (side.emission == Rgb(0.0)) {
      light.lit = std::max(light.lit, solution.radiosity[e].g);
    }
  }
  light.dark /= area;
  return light;
}

/// The largest irradiance a dark room has where w (h - w) / h <= h / 4 of every
/// metre of the wall's outline leaks, and all is absorbed there in the end.
double leak_bound(double h, double radiosity) {
  const double outline = 2.0 * (room_size.y + room_size.z),
               area = 2.0 * room_size.y * room_size.z + outline * (room_size.x - wall_x);
  return 0.25 * h * outline * radiosity / (area * (1.0 - reflectance));
}

TEST(StandingWalls, LightHardlyLeaksPastThem) {
  for (const Wall wall : {Wall::sheet, Wall::body})
    for (const double size : {0.6, 0.3, 0.15}) {
      const BothSides before = light_of(wall, size, false), after = light_of(wall, size, true);
      EXPECT_LT(after.dark, leak_bound(size / 8.0, after.lit)) << size;
      EXPECT_LT(after.dark, 0.5 * before.dark) << size;
    }
  // It is no small matter, with elements as a draft has them.
  const BothSides before = light_of(Wall::sheet, 0.3, false);
  EXPECT_GT(before.dark, leak_bound(0.3 / 8.0, before.lit));
}

// --- What is divided

constexpr Point3 foot(0.017, 0.0, 0.023); ///< of the sheet
Vec3 along(double angle) { return {std::cos(angle), 0.0, std::sin(angle)}; }
Vec3 across(double angle) { return {-std::sin(angle), 0.0, std::cos(angle)}; }

/// A floor of 2 x 2 m, as a quad or as a triangle of that height,
/// and a sheet through its middle, turned about the vertical.
Scene floor_and_sheet(bool triangle, double angle) {
  Scene scene;
  std::vector<Point3> floor{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  if (triangle)
    floor = {{-1.6, 0, 1}, {1.6, 0, 1}, {0.2, 0, -1.2}};
  add_polygon(scene, "floor", floor, diffuse(0.5));
  const Point3 from = foot - 4.0 * along(angle), to = foot + 4.0 * along(angle), up(0.0, 1.0, 0.0);
  add_polygon(scene, "sheet", {from, to, to + up, from + up}, double_sided(diffuse(0.5)));
  return scene;
}

/// sum A f (1 - f) over the floor, f the share of an element on one side of the sheet:
/// what of its area leaks.
double leaking_area(const ElementMesh& mesh, const SurfaceModel& surfaces, double angle) {
  constexpr int n = 48;
  double leaking = 0.0;
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const MeshCell& cell = cell_of(mesh, static_cast<ElementId>(e));
    const MeshSide& side = mesh.sides[index(cell.side)];
    if (std::abs(side.normal.y) < 0.5)
      continue;
    int inside = 0, beyond = 0;
    for (int k = 0; k < n * n; ++k) {
      const Vec2 st((k % n + 0.5) / n, (k / n + 0.5) / n);
      if (side.triangle && st.x + st.y > 1.0)
        continue;
      const Point3 x = point_at(surfaces.patches[index(side.patch)], patch_uv_of(mesh, cell, st));
      ++inside;
      beyond += glm::dot(x - foot, across(angle)) > 0.0 ? 1 : 0;
    }
    const double f = double(beyond) / inside;
    leaking += mesh.area[e] * f * (1.0 - f);
  }
  return leaking;
}

/// Of the sheet's line, in metres.
double length_on_floor(const LitScene& l, double angle) {
  constexpr int steps = 4000;
  constexpr double step = 8.0 / steps;
  int inside = 0;
  for (int k = 0; k < steps; ++k) {
    const Point3 beside = foot + ((k + 0.5) * step - 4.0) * along(angle) + 1e-4 * across(angle);
    inside += closest_hit(*l.rays, {beside + Vec3(0.0, 0.5, 0.0), {0.0, -1.0, 0.0}}) ? 1 : 0;
  }
  return inside * step;
}

TEST(StandingWalls, AreFollowedWhicheverWayTheyRun) {
  // No more leaks of a metre than w (h - w) / h <= h / 4 of the smallest elements,
  // but for a fifth where corners are cut off.
  constexpr double size = 0.25, smallest = size / 8.0;
  for (const bool triangle : {false, true})
    for (const double angle : {0.0, 0.3, 0.785, 1.2, 1.571}) {
      const auto l = lit(floor_and_sheet(triangle, angle), {.element_size = size});
      const double bound = 1.2 * 0.25 * smallest * length_on_floor(*l, angle);
      EXPECT_LT(leaking_area(divided(*l), l->surfaces, angle), bound) << triangle << ' ' << angle;
      EXPECT_GT(leaking_area(l->mesh, l->surfaces, angle), 1.5 * bound) << triangle << ' ' << angle;
    }
}

TEST(StandingWalls, AreTheSameWhereverTheSceneLiesHoweverLarge) {
  const auto l = lit(floor_and_sheet(true, 0.3), {.element_size = 0.25});
  ASSERT_NE(division_of(divided(*l)), division_of(l->mesh));
  const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
  const auto moved =
      lit(transformed(l->scene, turn, 1e-3, Vec3(2.0, -1.0, 0.5)), {.element_size = 0.25e-3});
  EXPECT_EQ(division_of(divided(*l)), division_of(divided(*moved)));
}

/// A floor of 2 x 2 m in elements of 0.25 m, with one thing on it.
Scene floor_with(const std::vector<Point3>& corners, const Material& material) {
  Scene scene;
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, diffuse(0.5));
  if (!corners.empty())
    add_polygon(scene, "thing", corners, material);
  return scene;
}
std::vector<Point3> upright(double x, double low, double high) {
  return {{x, low, -1}, {x, low, 1}, {x, high, 1}, {x, high, -1}};
}
std::size_t elements_more(const Scene& scene) {
  const auto l = lit(scene, {.element_size = 0.25});
  return element_count(divided(*l)) - element_count(l->mesh);
}

TEST(StandingWalls, NothingElseDividesElements) {
  const Material paper = double_sided(diffuse(0.5));
  Material pane;
  pane.transmission = 1.0;
  EXPECT_GT(elements_more(floor_with(upright(0.1, 0.0, 1.0), paper)), 0U);
  EXPECT_GT(elements_more(floor_with(upright(0.1, -1.0, 1.0), paper)), 0U) << "through the floor";
  EXPECT_GT(elements_more(floor_with(upright(0.1, 0.005, 1.0), paper)), 0U) << "a hair above it";
  EXPECT_GT(elements_more(floor_with(upright(0.1, 0.0, 1.0), double_sided(mirror(0.9)))), 0U);

  EXPECT_EQ(elements_more(floor_with({}, paper)), 0U);
  EXPECT_EQ(elements_more(floor_with(upright(0.25, 0.0, 1.0), paper)), 0U) << "between elements";
  EXPECT_EQ(elements_more(floor_with(upright(0.1, 0.1, 1.0), paper)), 0U) << "hangs over it";
  EXPECT_EQ(elements_more(floor_with(upright(0.1, -1.0, 0.0), paper)), 0U) << "below";
  EXPECT_EQ(elements_more(floor_with(upright(0.1, 0.0, 1.0), diffuse(0.5))), 0U)
      << "nothing is lit behind a front";
  EXPECT_EQ(elements_more(floor_with(upright(0.1, 0.0, 1.0), double_sided(pane))), 0U);
  EXPECT_EQ(
      elements_more(floor_with({{-1, 0.1, 1}, {1, 0.1, 1}, {1, 0.1, -1}, {-1, 0.1, -1}}, paper)),
      0U)
      << "along it";

  // Boxes leave no light to leak where they fill an element, and light goes round legs.
  for (const double size : {0.1, 0.6}) {
    Scene scene = floor_with({}, paper);
    add_box(scene, "box", {-0.05 - size, 0.0, -0.05 - size}, {-0.05, 0.5, -0.05}, diffuse(0.5));
    EXPECT_EQ(elements_more(scene), 0U) << size;
  }
}

TEST(StandingWalls, HolesArePassed) {
  // Of a screen across the whole floor one half is bars, the other gone down to the ground.
  Material screen = double_sided(diffuse(0.5));
  screen.alpha_mode = AlphaMode::mask;
  const auto l = lit(floor_with(upright(0.1, 0.0, 1.0), screen), {.element_size = 0.25});
  const Scene& scene = l->scene;
  l->rays.emplace(scene, l->surfaces, [&scene](TriangleId triangle, Vec2 b) {
    const auto x = corners(scene, triangle);
    return ((1.0 - b.x - b.y) * x[0] + b.x * x[1] + b.y * x[2]).z > 0.0;
  });
  const ElementMesh mesh = divided(*l);
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const auto element = static_cast<ElementId>(e);
    const int most = centre_of(mesh, element).z > 0.5 ? 0 : 3;
    EXPECT_LE(cell_of(mesh, element).level, most);
  }
  EXPECT_GT(element_count(mesh), element_count(l->mesh));
}

TEST(StandingWalls, EndWhereElementsWouldBeTooMany) {
  const auto l = lit(floor_and_sheet(false, 0.3), {.element_size = 0.25});
  const std::size_t before = element_count(l->mesh), after = element_count(divided(*l));
  std::size_t last = after;
  for (std::size_t most = after; most + 1 > before; --most) {
    const std::size_t count = element_count(divided(*l, {.max_elements = most}));
    EXPECT_LE(count, std::max(most, before));
    EXPECT_LE(count, last);
    last = count;
  }
  EXPECT_EQ(last, before);
}

} // namespace
} // namespace meninas::test
