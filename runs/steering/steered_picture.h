// One picture of a run that chooses its own settings, with what the next one can use of it.
//
// Pass one is kept where elements and rays stay what they are, the field of the view (raytrace/views/view_light.h)
// where only samples change: the picture is the same to the bit as if all were made anew.
// Costs are counted in rays where an error alone is wanted, so that every run chooses alike whatever else the
// machine does, and in seconds where a time is.
#pragma once

#include "runs/steering/steering_model.h"
#include "runs/view.h"

#include <chrono>
#include <memory>
#include <optional>

namespace meninas {

/// Thrown where work tells its progress, to end it.
struct OutOfTime {};

/// At least one of them is wanted.
struct Goal {
  std::optional<double> error;   ///< relative error of the picture
  std::optional<double> seconds; ///< of the whole run
};

struct SteeringRequest {
  const Scene& scene;
  const Camera& camera;
  PictureSize size;
  RunSettings settings; ///< what is set here stays; the other parameters are turned
  Goal goal;
  double spent = 0.0;   ///< seconds of the goal's before
  double reserve = 0.0; ///< seconds of the goal's for what comes after
};

/// The settings of the request, with adaptive samples where their number is free.
/// The numbers that no parameter turns are those of `normal` below 3 %, else of a draft.
RunSettings settings_of(const SteeringRequest& request);

/// The parameters that may be turned: those that the settings leave open.
FreeParameters free_parameters(const RunSettings& settings);

/// The parameters of a quick look.
Parameters first_parameters(const RunSettings& settings);

/// The settings as they are with these parameters; the link error goes with the elements.
RunSettings with_parameters(RunSettings settings, const FreeParameters& free, const Parameters& parameters);

/// The field of the view, which more samples leave as it is.
struct KeptView {
  std::shared_ptr<const IrradianceField> field;
  std::uint64_t shadow_rays = 0; ///< that finding it took
  double seconds = 0.0;          ///< likewise, of the first picture by it
};

/// One run under way, with what later ones can use of it.
struct Steering {
  const SteeringRequest& request;
  const RunEvents& events;
  RunSettings settings; ///< that parameters are turned of
  FreeParameters free;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::optional<LitScene> lit = {};
  RunFigures figures = {}; ///< of `lit`
  std::optional<Parameters> lit_with = {};
  std::optional<KeptView> view = {};
  bool warned = false;
  double estimate_seconds = 0.0; ///< what telling the error of the picture under way is foretold to take

  /// Cost is counted in rays if only an error is wanted, so that every run chooses alike; else in seconds.
  bool counts_rays() const { return !request.goal.seconds; }

  double spent() const;
  double left() const; ///< infinite where no time is wanted
};

struct SteeredRun {
  ViewPicture picture;
  RunFigures figures;
  MeasuredRun measured;
};

/// Makes a picture and estimates its error by twice as many pixels as are usual.
/// Throws OutOfTime if `may_end` and the time is over, but for what telling the error will take.
SteeredRun run_with(Steering& steering, const Parameters& parameters, bool may_end);

} // namespace meninas
