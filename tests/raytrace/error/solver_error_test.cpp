// What the solver leaves, in a room that is not the brightest part of its scene.
#include "image/metrics/relative_error.h"
#include "raytrace/error/picture_error.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// A lantern that is shut holds light ten million times as bright as the room's.
Scene room_with_shut_lantern() {
  Scene scene = half_room_with_small_mirror();
  add_room(scene, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3},
           {diffuse(0.9, 1e7), diffuse(0.9), diffuse(0.9), diffuse(0.9), diffuse(0.9), diffuse(0.9)});
  add_box(scene, "lantern", {0.19, 0.19, 0.19}, {0.31, 0.31, 0.31}, diffuse(0.5));
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 0.6, 1.0}, 1.4)};
  return scene;
}

struct Pictured {
  Image image;
  double solver; ///< that part of its estimated error
};

Pictured pictured(MeshCut mesh, double tolerance) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.3;
  settings.pass_one.cut = mesh;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 128;
  settings.pass_one.solver.tolerance = tolerance;
  settings.render.width = settings.render.height = 40;
  settings.render.samples = 16;
  const auto prepared = prepare_scene(room_with_shut_lantern(), settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
  const Camera& camera = prepared->scene.cameras.front();
  const Image image = render(solution.field, camera, settings.render).image;
  const PictureError error = estimate_error(solution.field, camera, settings, solution.solver,
                                            {image, {}}, {.gathered_pixels = 64, .pixels = 256});
  return {image, error.solver};
}

// The room is solved all the same, to ten tolerances, and what is left in the lantern is no error of the picture.
TEST(SolverError, IsThatOfTheRoomNotOfTheBrightestSpot) {
  for (const MeshCut mesh : {MeshCut::uniform, MeshCut::hierarchical}) {
    const Pictured picture = pictured(mesh, 1e-4), exact = pictured(mesh, 1e-12);
    EXPECT_LT(relative_error(picture.image, exact.image, {}), 1e-3);
    EXPECT_LT(picture.solver, 1e-3);
  }
}

} // namespace
} // namespace meninas::test
