// The choice of the settings for the next run, with its reason, from the forecast of the runs measured so far
// (raytrace/error/error_forecast.h).
#pragma once

#include "raytrace/error/error_forecast.h"

#include <string>

namespace meninas {

/// Parameters a user has set are not turned.
struct FreeParameters {
  bool elements = true, rays = true, samples = true, term = true;
};

/// The next change of parameters, and its reason.
struct NextRun {
  Parameters parameters;
  Forecast forecast;
  std::string why;
};

/// The quickest combination of parameters predicted to bring the error below `error`, among those
/// that are not below the present ones and cost no more than `cost`. If none does, the quickest within a
/// hundredth of the lowest predicted error; the present parameters if none lowers it.
NextRun next_run(const MeasuredRun& run, const FreeParameters& free, double error, double cost);

/// After a run that was no better: without the parameters whose turning did not help their own part of the error
/// either, of which the estimate does not know what is wrong. Light is not gathered at hits once more.
FreeParameters worth_changing(FreeParameters free, const MeasuredRun& before, const MeasuredRun& turned);

} // namespace meninas
