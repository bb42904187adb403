// Which settings a run is made with next, and why, as what it has measured foretells
// (raytrace/error/error_forecast.h).
#pragma once

#include "raytrace/error/error_forecast.h"

#include <string>

namespace meninas {

/// Parameters a user has set are not turned.
struct FreeKnobs {
  bool elements = true, rays = true, samples = true, term = true;
};

/// What is turned next, and why.
struct NextRun {
  Parameters knobs;
  Forecast forecast;
  std::string why;
};

/// Of all combinations of the knobs, from what they are up, that fit into `seconds`
/// the quickest that is foretold to bring the error below `error`, or, where none does,
/// that brings it as low as any, to a hundredth. The same knobs as before where none lowers it.
NextRun next_run(const MeasuredRun& run, const FreeKnobs& free, double error, double seconds);

} // namespace meninas
