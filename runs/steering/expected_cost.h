// What a run is going to take, before it: seconds on this machine and bytes.
//
// Pass one as radiosity/expected_cost.h says; pass two is
//
//   render         pixels x (samples x one camera ray with its diffuse term
//                            + vertices of the view's field x one hit with direct light)
//
// over the threads that work. What is measured is a few thousandths of the work,
// so that it takes a fraction of a second in any scene. Bytes come from counts (memory.h). Limit: references are not foretold, they end when told.
#pragma once

#include "raytrace/two_pass.h"
#include "runs/run_settings.h"

#include <cstdint>

namespace meninas {

struct ExpectedCost {
  double prepare = 0.0; ///< seconds: load, plan, mesh, and starting the program
  double form_factors = 0.0, solve = 0.0, interpolate = 0.0, render = 0.0, write = 0.0;
  double total = 0.0;
  std::uint64_t bytes = 0; ///< resident, at most
};

/// `loading` in seconds is what reading the scene took.
ExpectedCost expect_cost(const PreparedScene& prepared, const Camera& camera, PictureSize size,
                         const RunSettings& settings, double loading, int threads);

} // namespace meninas
