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

/// The quickest combination of parameters predicted to bring the error below `error`, among those
/// that are not below the present ones and cost no more than `cost`. If none does, the quickest within a
/// hundredth of the lowest predicted error; the present parameters if none lowers it.
NextRun next_run(const MeasuredRun& run, const FreeKnobs& free, double error, double cost);

/// After a run that was no better: without the parameters whose turning did not help their own part of the error
/// either, of which the estimate does not know what is wrong. Light is not gathered at hits once more.
FreeKnobs worth_turning(FreeKnobs free, const MeasuredRun& before, const MeasuredRun& turned);

} // namespace meninas
