#include "runs/steering/expected_cost.h"

#include "radiosity/expected_cost.h"
#include "raytrace/error/picture_cost.h"
#include "runs/steering/memory.h"

namespace meninas {

ExpectedCost expect_cost(const PreparedScene& prepared, const Camera& camera, PictureSize size,
                         const RunSettings& asked, double loading, int threads) {
  constexpr double started = 0.03;                        // program and its libraries
  constexpr double busy = 0.9;                            // of the threads, on average
  constexpr double encoded_pixel = 1.5e-7;
  const RunSettings settings = settled(asked, *prepared.light());
  TwoPassSettings two_pass = two_pass_settings(settings);
  two_pass.render.width = size.width;
  two_pass.render.height = size.height;
  const double share = 1.0 / (busy * threads);
  const PassOneCost pass_one =
      expected_cost(*prepared.light(), prepared.plan.bands, two_pass.pass_one);

  ExpectedCost cost;
  cost.prepare = started + loading + prepared.seconds.plan + prepared.seconds.mesh;
  cost.form_factors = share * pass_one.form_factors;
  cost.interpolate = share * pass_one.interpolate;
  cost.solve = pass_one.solve;
  cost.render = expected_render_seconds(prepared.light(), camera, two_pass.render);
  cost.write = 0.01 + encoded_pixel * double(size.width) * size.height;
  cost.total =
      cost.prepare + cost.form_factors + cost.solve + cost.interpolate + cost.render + cost.write;
  cost.bytes = expected_memory(sizes_of(prepared.scene, settings.lamps), settings, size);
  return cost;
}

} // namespace meninas
