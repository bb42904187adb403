#include "runs/report/run_progress.h"

#include <algorithm>
#include <cmath>

namespace meninas {

void RunProgress::begin(std::vector<RunStage> stages, double now) {
  *this = RunProgress();
  double sum = 0.0;
  for (const RunStage& stage : stages)
    sum += stage.share;
  for (RunStage& stage : stages)
    stage.share /= sum;
  stages_ = std::move(stages);
  begin_ = reported_ = now;
}

double RunProgress::share_before(std::size_t stage) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < stage; ++k)
    sum += stages_[k].share;
  return sum;
}

/// The number of the stage that is meant, or of none.
std::size_t RunProgress::stage_of_report(std::string_view name, double fraction) const {
  constexpr double restart = 0.5; // a fall of the fraction that no order of tasks explains
  // A task of the stage before may report after its last one has.
  if (is_new_ && current_ > 0 && stages_[current_ - 1].name == name && fraction > restart)
    return stages_.size();
  for (std::size_t k = current_; k < stages_.size(); ++k) {
    const bool over = k == current_ && fraction < fraction_ - restart;
    if (stages_[k].name == name && !over)
      return k;
  }
  return stages_.size();
}

void RunProgress::report(std::string_view stage, double fraction, double now) {
  const bool known = std::ranges::find(stages_, stage, &RunStage::name) != stages_.end();
  if (!known)
    begin({{std::string(stage), 1.0}}, now);
  const std::size_t k = stage_of_report(stage, fraction);
  if (k == stages_.size())
    return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double done = share_before(k) + stages_[k].share * fraction;
  if (done > done_) {
    shown_ = std::max(done, state(now).done);
    done_ = done;
    reported_ = now;
  }
  current_ = k;
  is_new_ = false;
  fraction_ = fraction;
  if (fraction_ >= 1.0 && k + 1 < stages_.size()) {
    current_ = k + 1;
    fraction_ = 0.0;
    is_new_ = true;
  }
}

RunState RunProgress::state(double now) const {
  if (stages_.empty())
    return {};
  RunState state{stages_[current_].name, shown_, std::nullopt};
  const double elapsed = now - begin_, room = share_before(current_) + stages_[current_].share - shown_;
  if (reported_ > begin_ && room > 0.0) {
    const double rate = done_ / (reported_ - begin_);
    state.done += room * (1.0 - std::exp(-rate * (now - reported_) / room));
  }
  constexpr double too_little = 0.02;
  if (state.done > too_little && done_ < 1.0)
    state.seconds_left = elapsed * (1.0 - state.done) / state.done;
  return state;
}

} // namespace meninas
