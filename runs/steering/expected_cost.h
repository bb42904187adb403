// The expected cost of a run before it starts: seconds on this machine, and bytes.
//
// The sum of what pass one (radiosity/expected_cost.h) takes of one thread, over the threads that work, and of what
// pass two (raytrace/error/picture_cost.h) takes by all of them. To find out takes a fraction of a second in any scene. Bytes come from counts (memory.h).
// Limit: the time of references is not foretold.
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
