#include "tests/reference/agreement.h"

#include "raytrace/two_pass.h"
#include "tests/reference/tracing.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {

static Rgb seen_by_two_passes(const RadiositySolution& solution, const Sight& sight, DiffuseTerm term) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 64;
  settings.glossy_samples = 64;
  settings.diffuse.term = term;
  settings.diffuse.refinement.solid_rays = 1 << 14;
  return render(solution.field, look_at(sight.eye, sight.target, 1e-4), settings).image.pixels[0];
}

void expect_agreement(const Scene& scene, std::initializer_list<Sight> sights, const Agreement& how) {
  PassOneSettings settings;
  settings.mesh.element_size = 0.1;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  const auto prepared = prepare_scene(scene, settings);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
  for (const Sight& sight : sights) {
    SCOPED_TRACE(sight.what);
    constexpr double field_error = 0.01;
    const Rgb found = seen_by_two_passes(solution, sight, how.term);
    const MeanRadiance truth = radiance_seen(scene, sight.eye, sight.target, how.paths);
    for (int band = 0; band < 3; ++band) {
      EXPECT_LT(truth.error[band], how.noise * truth.mean[band]);
      EXPECT_NEAR(found[band], truth.mean[band],
                  4.0 * truth.error[band] + field_error * truth.mean[band]);
    }
  }
}

} // namespace meninas::test
