// `render --mode reference`: the picture of the path tracer, and how far it is to be believed.
#pragma once

#include "image/image.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"

namespace meninas {

/// Says the scene's warnings, traces, notes what stopped it and fills in its figures.
reference::ReferencePicture run_reference(Scene scene, const Camera& camera,
                                          const reference::ReferenceSettings& settings,
                                          const RunEvents& events, RunFigures& figures);

} // namespace meninas
