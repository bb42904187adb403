// A picture of a wanted accuracy, or the best within a wanted time:
// the run chooses its own settings.
//
// First a coarse run, in a fraction of a second, with an estimate of its error by part;
// then the quickest settings that are foretold to do, or the best that fit (steering_model.h),
// and again, until the estimate is below what was wanted or the time is over.
// An error alone is wanted by counted rays, never by the clock: the same choice and the same bits on every run.
// A run that changes pass two alone keeps pass one, and one that changes samples alone the field of the view. A
// parameter whose change did not help is not changed again. The picture with the smallest estimate is kept.
// Samples of pixels are adaptive (raytrace/pixels/sample_choice.h), to the wanted error in every pixel.
#pragma once

#include "runs/steering/steered_picture.h"

namespace meninas {

/// The figures are those of the picture's own run,
/// with the choice, but for the seconds, which are of all steps.
ViewPicture steer(const SteeringRequest& request, const RunEvents& events, RunFigures& figures);

} // namespace meninas
