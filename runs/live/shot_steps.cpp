#include "runs/live/shot_steps.h"

#include <chrono>

namespace meninas {

bool ShotSteps::paused() const {
  const std::scoped_lock lock(mutex_);
  return paused_;
}

void ShotSteps::pause(bool paused) {
  const std::scoped_lock lock(mutex_);
  paused_ = paused;
  steps_ = 0;
  goes_on_.notify_all();
}

void ShotSteps::gather(bool gathers) {
  const std::scoped_lock lock(mutex_);
  gathers_ = gathers;
  goes_on_.notify_all();
}

void ShotSteps::step() {
  constexpr int most = 1000;
  const std::scoped_lock lock(mutex_);
  paused_ = true;
  if (steps_ < most)
    ++steps_;
  goes_on_.notify_all();
}

void ShotSteps::wait(const std::function<bool()>& is_over, std::optional<bool> gathers) {
  constexpr std::chrono::milliseconds patience(100);
  std::unique_lock lock(mutex_);
  while (!goes_on_.wait_for(lock, patience, [&] { return !paused_ || steps_ > 0 || (gathers && gathers_ != *gathers); })) {
    lock.unlock();
    const bool over = is_over();
    lock.lock();
    if (over)
      return;
  }
  if (paused_ && steps_ > 0)
    --steps_;
}

} // namespace meninas
