// Progressive radiosity by shots where closed white parts of the scene have light of their own.
#include "radiosity/solvers/progressive.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

PassOneSettings shooting(double element_size) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  settings.interpolation.method = Interpolation::average;
  settings.solver = {SolverMethod::progressive, 1e-4};
  return settings;
}

// Beside a room like any other stands a white one with a lamp of its own, in which light would grow without end:
// it keeps what comes from its lamp, and the other room is as it is alone.
TEST(ProgressiveTraps, ReflectNothingAndLeaveTheRestAsItIs) {
  const auto scene_of = [](bool with_trap) {
    Scene scene;
    const Material wall = diffuse(0.5), white = diffuse(1.0);
    add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, diffuse(0.5, 1.0), wall, wall});
    const std::size_t first = scene.nodes.size();
    if (with_trap)
      add_room(scene, Point3(2.0), Point3(3.0), {white, white, white, diffuse(1.0, 1.0), white, white});
    for (std::size_t n = first; n < scene.nodes.size(); ++n)
      scene.nodes[n].name = "trap." + scene.nodes[n].name;
    return scene;
  };
  const PassOneSettings settings = shooting(0.125);
  const auto both = lit(scene_of(true), settings.mesh), alone = lit(scene_of(false), settings.mesh);
  const RadiositySolution solution = shoot_pass_one(both->light, settings),
                          room = shoot_pass_one(alone->light, settings);
  EXPECT_TRUE(solution.solver.converged);
  EXPECT_LT(solution.solver.error_bound, 1e-4);
  // The glowing wall of the trap has no light to reflect.
  EXPECT_EQ(solution.solver.trapped.size(), element_count(both->mesh) / 2 * 5 / 6);
  for (const std::uint32_t e : solution.solver.trapped)
    EXPECT_GT(both->mesh.vertices[index(both->mesh.corners[e][0])].x, 1.5);
  // Its lamp alone: the floor of a cube sees F = 0.1998 of the ceiling (C-11), and reflects it once.
  // Direct light is at few points of each element: 2 %.
  EXPECT_NEAR(mean_over(*both, solution.radiosity, "trap.y0").g, 0.1998, 0.02 * 0.1998);
  // Other samples: a floor is met by some 64 * 256 rays of reflected light.
  EXPECT_NEAR(mean_over(*both, solution.radiosity, "y0").g, mean_over(*alone, room.radiosity, "y0").g,
              0.01 * mean_over(*alone, room.radiosity, "y0").g);
}

// A trap may be one for red light alone: green and blue are solved as ever.
TEST(ProgressiveTraps, OfOneChannelLeaveTheOthersAsTheyAre) {
  Scene scene = furnace(0.5, {});
  const std::size_t first = scene.nodes.size();
  Material wall = diffuse(1.0, 1.0);
  wall.base_color = {1.0, 0.5, 0.5};
  add_room(scene, Point3(2.0), Point3(3.0), {wall, wall, wall, wall, wall, wall});
  for (std::size_t n = first; n < scene.nodes.size(); ++n)
    scene.nodes[n].name = "trap." + scene.nodes[n].name;
  const auto l = lit(std::move(scene), {.element_size = 0.25});
  const RadiositySolution shots = shoot_pass_one(l->light, shooting(0.25));
  EXPECT_TRUE(shots.solver.converged);
  EXPECT_EQ(shots.solver.trapped.size(), element_count(l->mesh) / 2);
  // E = 1 on all walls: where it is reflected once B = 1 + rho, where without end 1 / (1 - rho). A wall
  // of 16 elements is met by some 16 * 256 rays: 1.6 %.
  const Rgb trap = mean_over(*l, shots.radiosity, "trap.y0"), room = mean_over(*l, shots.radiosity, "y0");
  EXPECT_NEAR(trap.r, 2.0, 0.02 * 2.0);
  EXPECT_NEAR(trap.g, 2.0, 0.02 * 2.0);
  EXPECT_NEAR(room.r, 2.0, 0.02 * 2.0);
}

} // namespace
} // namespace meninas::test
