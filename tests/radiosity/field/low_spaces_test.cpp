// Spaces that are low against the elements of their walls:
// there is no open beside them to which their light could leak, so that the field has to be theirs.
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// How the field is found.
enum class By { rows, nodes };

PassOneSettings settings_by(By by) {
  PassOneSettings settings;
  settings.form_factors.rays = 256;
  settings.interpolation.rays = 256;
  settings.solver.tolerance = 1e-6;
  if (by == By::nodes)
    settings.cut = MeshCut::hierarchical;
  return settings;
}

RadiositySolution solve_by(By by, const std::shared_ptr<const LightScene>& light) {
  return solve_pass_one(light, settings_by(by));
}

/// Two squares that meet at an angle, in degrees, and what closes the room between them;
/// all glow with E = 1.
Scene wedge(double angle, double reflectance) {
  Scene scene;
  const double a = angle * std::numbers::pi / 180.0;
  const Point3 p(std::cos(a), std::sin(a), 0.0);
  const auto back = [](const Point3& x) { return Point3(x.x, x.y, -1.0); };
  const Material wall = diffuse(reflectance, 1.0);
  const Point3 edge(0.0), end(1.0, 0.0, 0.0);
  add_polygon(scene, "floor", {edge, end, back(end), back(edge)}, wall);
  add_polygon(scene, "roof", {edge, back(edge), back(p), p}, wall);
  add_polygon(scene, "opening", {end, p, back(p), back(end)}, wall);
  add_polygon(scene, "side", {edge, p, end}, wall);
  add_polygon(scene, "other side", {back(edge), back(end), back(p)}, wall);
  return scene;
}

/// A unit furnace over the middle of a dark ground of that size.
Scene furnace_on_ground(double reflectance, double size) {
  Scene scene = furnace(reflectance, {});
  const double low = 0.5 - 0.5 * size, high = 0.5 + 0.5 * size;
  add_polygon(scene, "ground",
              {{low, -0.01, low}, {low, -0.01, high}, {high, -0.01, high}, {high, -0.01, low}},
              diffuse(0.5));
  return scene;
}

struct LowFurnace {
  const char* name;
  Scene scene;
  double reflectance;
  MeshSettings mesh = {.target_elements = 2000};
};

class LowFurnaceTest : public testing::TestWithParam<std::tuple<std::size_t, By>> {};

LowFurnace low_furnace(std::size_t which) {
  switch (which) {
  case 0:
    return {"flat", furnace(0.5, {}, {1.0, 0.001, 1.0}), 0.5};
  case 1:
    return {"wedge of 1 degree", wedge(1.0, 0.9), 0.9};
  case 2:
    return {"wedge of 0.1 degrees", wedge(0.1, 0.9), 0.9};
  case 3: // which leaves one element a wall
    return {"on a ground", furnace_on_ground(0.95, 200.0), 0.95, {.element_size = 4.5}};
  default:
    return {"on a ground that leaves it elements", furnace_on_ground(0.95, 200.0), 0.95};
  }
}

// B = E / (1 - rho), and H is the same, at every vertex of the room. Rows close exactly:
// what is left is the solver's tolerance, and floats.
TEST_P(LowFurnaceTest, EveryVertex) {
  const auto [which, by] = GetParam();
  const LowFurnace room = low_furnace(which);
  const auto l = lit(room.scene, room.mesh);
  const RadiositySolution solution = solve_by(by, l->light);
  EXPECT_TRUE(solution.solver.converged);
  const ElementMesh& mesh = solution.field.mesh();
  std::size_t seen = 0;
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[e])];
    if (l->scene.nodes[index(side.node)].name == "ground")
      continue;
    for (const ElementVertexId v : mesh.corners[e]) {
      EXPECT_NEAR(double{solution.field.irradiance[index(v)].g} * (1.0 - room.reflectance), 1.0,
                  1e-3)
          << room.name << ' ' << l->scene.nodes[index(side.node)].name;
      ++seen;
    }
  }
  EXPECT_GT(seen, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, LowFurnaceTest,
                         testing::Combine(testing::Values(0, 1, 2, 3, 4),
                                          testing::Values(By::rows, By::nodes)));

/// A room of 4 x 3 x 5 m with a lamp in the middle of it, whose walls are one element each.
std::unique_ptr<LitScene> room_of_large_elements() {
  Scene scene;
  add_room(scene, Point3(0.0), {4.0, 3.0, 5.0},
           {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
  add_polygon(scene, "lamp", {{1.5, 2.5, 2.0}, {2.5, 2.5, 2.0}, {2.5, 2.5, 3.0}, {1.5, 2.5, 3.0}},
              diffuse(0.0, 10.0));
  return lit(std::move(scene), {.element_size = 20.0});
}

// Walls of area A get Phi / (A (1 - rho)) in the mean: no corner is dark against that.
// Those of the floor, which the lamp lights most in its middle, have half to all of its light.
TEST(LowSpaces, ARoomOfOneElementAWall) {
  const auto l = room_of_large_elements();
  constexpr double mean = 10.0 / (94.0 * (1.0 - 0.5));
  for (const By by : {By::rows, By::nodes}) {
    const RadiositySolution solution = solve_by(by, l->light);
    for (const glm::vec3& h : solution.field.irradiance)
      EXPECT_GT(double{h.g}, 0.25 * mean);
    for (const std::size_t e : elements_of(*l, "y0"))
      for (const ElementVertexId v : l->mesh.corners[e])
        EXPECT_NEAR(double{solution.field.irradiance[index(v)].g} / solution.irradiance[e].g, 0.75,
                    0.25);
  }
}

/// A lit room with a panel a centimetre before the wall z0, of which it hides four ninths.
Scene panel_before_wall() {
  Scene scene;
  add_room(scene, Point3(0.0), {3.0, 3.0, 3.0},
           {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
  add_polygon(scene, "lamp", {{1.0, 2.7, 1.0}, {2.0, 2.7, 1.0}, {2.0, 2.7, 2.0}, {1.0, 2.7, 2.0}},
              diffuse(0.0, 10.0));
  add_polygon(scene, "panel",
              {{0.5, 0.5, 0.01}, {2.5, 0.5, 0.01}, {2.5, 2.5, 0.01}, {0.5, 2.5, 0.01}},
              diffuse(0.3));
  return scene;
}

// Behind the panel the wall is dark, whoever has found that. Nodes gather by 256 rays and rows
// take the mean of elements: the shares of a wall in the light agree to a few per cent of it,
// and all that is emitted is absorbed but for as much as rays are noisy.
TEST(LowSpaces, NodesDoNotLightAWallBehindAPanel) {
  const auto l = lit(panel_before_wall(), {.element_size = 0.2});
  const RadiositySolution rows = solve_by(By::rows, l->light),
                          nodes = solve_by(By::nodes, l->light);
  EXPECT_NEAR(mean_over(*l, nodes.irradiance, "z0").g / mean_over(*l, rows.irradiance, "z0").g, 1.0,
              0.03);
  EXPECT_LT(std::abs(nodes.energy.imbalance), 0.01);
}

// Where elements are few of their receiver's, what others leave of its light is nothing but the
// noise of these: beside the foot of a box one was black, one 35 times as bright as it is,
// and the corner of the box over that 28 times. Rows of 256 rays know a single element there to
// a factor of 1.6 and nodes to 2, with other seeds to 3 where a tenth of it is exposed,
// so that rows have to be better. A vertex of the box sees many elements, to 2.
TEST(LowSpaces, NodesDoNotLightTheFootOfABoxByTheirNoise) {
  const auto l = lit(load_gltf(source_dir() + "/scenes/gallery/cornell.gltf"),
                     {.element_size = 0.0857});
  PassOneSettings exact = settings_by(By::rows);
  exact.form_factors.rays = 1024;
  exact.direct.points = exact.direct.max_points = 64;
  const RadiositySolution rows = solve_pass_one(l->light, exact),
                          nodes = solve_by(By::nodes, l->light);
  for (const std::size_t e : elements_of(*l, "floor")) {
    if (rows.exposed[e] > 0.1F && nodes.exposed[e] > 0.1F) {
      EXPECT_LT(std::abs(std::log(nodes.irradiance[e].g / rows.irradiance[e].g)), std::log(2.5));
    }
  }
  for (const std::size_t e : elements_of(*l, "short-block"))
    for (const ElementVertexId v : l->mesh.corners[e]) {
      if (rows.field.irradiance[index(v)].g > 0.01F) {
        EXPECT_LT(nodes.field.indirect[index(v)].g, 2.0F * rows.field.indirect[index(v)].g);
      }
    }
}

} // namespace
} // namespace meninas::test
