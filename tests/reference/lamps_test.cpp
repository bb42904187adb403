// Relit pictures of the two passes against paths in the scene whose lamps are so bright.
#include "radiosity/relight.h"
#include "raytrace/two_pass.h"
#include "scenes/lamps.h"
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

// One solve, and two states of its lamps; seen straight, and in the mirror that is the wall x = 0.
TEST(RelitTwoPasses, AgreeWithPathsUnderTheSameLamps) {
  Scene scene = half_room();
  add_polygon(scene, "second",
              {{1.99, 1.0, 1.0}, {1.99, 1.0, 1.6}, {1.99, 1.6, 1.6}, {1.99, 1.6, 1.0}},
              diffuse(Rgb(0.0), Rgb(4.0, 8.0, 12.0)));
  PassOneSettings settings;
  settings.mesh.element_size = 0.1;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  settings.lamps = LampGrouping::node;
  const auto prepared = prepare_scene(scene, settings);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
  const LampGroups lamps = find_lamps(scene, LampGrouping::node);
  ASSERT_EQ(lamps.size(), 2U);
  struct Sight {
    const char* what;
    Point3 eye, target;
  };
  const Sight sights[] = {{"a wall", {1.0, 1.2, 1.5}, {0.9, 0.8, 0.0}},
                          {"the floor", {1.0, 1.2, 1.5}, {1.5, 0.0, 2.3}},
                          {"the floor in the mirror", {1.6, 1.2, 1.5}, {-1.4, 0.0, 2.2}}};
  for (const std::vector<Rgb>& factors :
       {std::vector<Rgb>{Rgb(0.0), Rgb(1.0)}, std::vector<Rgb>{Rgb(0.1, 0.5, 0.2), Rgb(2.0)}}) {
    const IrradianceField field = relit(solution.field, factors);
    const Scene bright = relit(scene, lamps, factors);
    for (const Sight& sight : sights) {
      SCOPED_TRACE(sight.what);
      RenderSettings view;
      view.width = view.height = 1;
      view.samples = 64;
      view.diffuse.term = DiffuseTerm::direct;
      const Rgb found = render(field, look_at(sight.eye, sight.target, 1e-4), view).image.pixels[0];
      const MeanRadiance truth = radiance_seen(bright, sight.eye, sight.target, 512);
      constexpr double field_error = 0.02; // of elements of 10 cm, for a lamp that is a part of all
      for (int band = 0; band < 3; ++band)
        EXPECT_NEAR(found[band], truth.mean[band],
                    4.0 * truth.error[band] + field_error * truth.mean[band]);
    }
  }
}

} // namespace
} // namespace meninas::test
