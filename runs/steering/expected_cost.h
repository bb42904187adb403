// What a run is going to take, before it: seconds on this machine and bytes.
//
// Stages are counted in what they do most of,
// and a few of each are done to see how long one takes here, in this scene:
//
//   form factors   elements x (one gathering of N rays + some points of direct light)
//   interpolate    vertices x (one gathering + one point of direct light)
//                  `--solver hierarchical` gathers for nodes instead, of which there are about
//                  twice those of its beginning, and finds direct light for nodes
//   solve          entries of the transport x products with it, at the rate of memory
//   render         pixels x samples x one camera ray with its diffuse term
//
// over the threads that work. What is measured is a few thousandths of the work,
// so that it takes a fraction of a second in any scene. Bytes come from counts (memory.h). Limits:
// how far an adaptive field divides elements is not known beforehand, it is taken to have
// as many more as rooms with a lamp have (too few by up to ten times where much is small:
// figures of many facets); references are not foretold, they end when told.
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
