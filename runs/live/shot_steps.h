// Shots one by one, for teaching: whoever solves waits here before each, as long as somebody has stopped it.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

namespace meninas {

/// One solves; any others may say how it goes on.
class ShotSteps {
public:
  explicit ShotSteps(bool paused) : paused_(paused) {}

  bool paused() const;
  void pause(bool paused);
  /// One shot more, and then none.
  void step();
  /// Returns when the next shot may be made. Meanwhile `is_over` is asked ten times a second, and ends it.
  void wait(const std::function<bool()>& is_over);

private:
  mutable std::mutex mutex_;
  std::condition_variable goes_on_;
  bool paused_ = false;
  int steps_ = 0; ///< that are allowed
};

} // namespace meninas
