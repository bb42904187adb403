// The map of the error, of an estimate that is made up.
#include "raytrace/error/error_map.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

// Single rays at edges are further off than an estimate of a thousandth that has no part of edges: all pixels have their
// share of it nevertheless, of the radiance below four times the mean.
TEST(ErrorMap, EdgesLeaveTheErrorOfGatheredLightWhereItIs) {
  const Scene scene = half_room_with_small_mirror();
  const Camera camera = look_at({1.8, 1.1, 2.8}, {0.4, 1.3, 1.0}, 1.7);
  TwoPassSettings settings;
  settings.pass_one.mesh.target_elements = 300;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 64;
  settings.render.width = 32;
  settings.render.height = 24;
  settings.render.samples = 4;
  const Taken lit = lit_up(scene, settings.pass_one);
  const Image shown = picture(lit, camera, settings.render);
  PictureError error;
  error.mean_radiance = 1.0;
  error.total = error.form_factors = 0.001;
  const Image map = error_map(lit.solution.field, camera, settings, shown, error);
  double squares = 0.0;
  for (const glm::vec3& pixel : shown.pixels)
    squares += glm::dot(glm::min(glm::dvec3(pixel), 4.0), glm::min(glm::dvec3(pixel), 4.0));
  const double share = error.total * std::sqrt(3.0 * double(shown.pixels.size()) / squares);
  for (std::size_t p = 0; p < map.pixels.size(); ++p)
    EXPECT_GE(double{map.pixels[p].g}, 0.999 * share * double{shown.pixels[p].g}) << p;
}

} // namespace
} // namespace meninas::test
