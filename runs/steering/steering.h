// A picture of a wanted accuracy, or the best within a wanted time:
// the run chooses its own settings.
//
// First a coarse run, in a fraction of a second, with an estimate of its error by part;
// then the quickest settings that are foretold to do, or the best that fit (steering_model.h),
// and again, until the estimate is below what was wanted or the time is over.
// A run that changes pass two alone keeps pass one. A parameter whose change did not help is not
// changed again. The picture with the smallest estimate is kept.
// Samples of pixels are adaptive (raytrace/pixels/sample_choice.h), to the wanted error in every pixel.
#pragma once

#include "runs/steering/steering_model.h"
#include "runs/view.h"

#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// At least one of them is wanted.
struct Goal {
  std::optional<double> error;   ///< relative error of the picture
  std::optional<double> seconds; ///< of the whole run
};

struct SteeringRequest {
  const Scene& scene;
  const Camera& camera;
  PictureSize size;
  RunSettings settings; ///< what is set here stays; the other knobs are turned
  Goal goal;
  double spent = 0.0;   ///< seconds of the goal's before
  double reserve = 0.0; ///< seconds of the goal's for what comes after
};

/// The figures are those of the picture's own run,
/// with the choice, but for the seconds, which are of all steps.
ViewPicture steer(const SteeringRequest& request, const RunEvents& events, RunFigures& figures);

} // namespace meninas
