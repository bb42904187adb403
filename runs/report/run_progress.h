// The progress of a whole run: one fraction over all of its stages, and the time left for all of them.
//
// A run names its stages beforehand with the shares of its time that they usually take. Work reports
// a stage and the fraction of it that is done. Some stages never report: they begin when the stage
// before them is complete. With the elapsed time t and the fraction d that is done by reports,
//   rate = d / t,
// and between reports the fraction goes on at this rate, ever more slowly towards the end of the
// stage, which it does not reach:  s + r (1 - exp(-rate dt / r)), r what is left of the stage after s,
// d or what was shown at the last report, whichever is more.
// So no stage stands still or falls back, and none claims to be complete before it is.
#pragma once

#include "runs/run_events.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meninas {

struct RunState {
  std::string stage;
  double done = 0.0;                  ///< of the run, 0 to 1
  std::optional<double> seconds_left; ///< not known while too little is done
};

class RunProgress {
public:
  /// Stages that are not among these count as a run of their own.
  void begin(std::vector<RunStage> stages, double now);
  /// Reports of a stage that is over are heard no more; one that starts again from nothing is the
  /// next of its name. `now` in seconds, from any beginning.
  void report(std::string_view stage, double fraction, double now);
  RunState state(double now) const;

private:
  std::size_t stage_of_report(std::string_view name, double fraction) const;
  double share_before(std::size_t stage) const;

  std::vector<RunStage> stages_;
  std::size_t current_ = 0;
  double fraction_ = 0.0; ///< of the current stage, as last reported
  bool is_new_ = false;   ///< the current stage follows a complete one and has not reported yet
  double done_ = 0.0;     ///< of the run, at `reported_`
  double shown_ = 0.0;    ///< s, at `reported_`
  double begin_ = 0.0, reported_ = 0.0;
};

} // namespace meninas
