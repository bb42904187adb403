// Shots one by one, or sweeps of gathering, for teaching: whoever solves waits here before each, as long as somebody
// has stopped it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

namespace meninas {

/// One solves; any others may say how it goes on.
class ShotSteps {
public:
  explicit ShotSteps(bool paused) : paused_(paused) {}

  /// Whether elements gather, sweep by sweep, where they would shoot.
  bool gathers() const { return gathers_; }
  void gather(bool gathers);

  bool paused() const;
  void pause(bool paused);
  /// One shot more, and then none.
  void step();
  /// Returns when the next shot may be made, or at once where elements do not gather as `gathers` has it. Meanwhile
  /// `is_over` is asked ten times a second, and ends it.
  void wait(const std::function<bool()>& is_over, std::optional<bool> gathers = std::nullopt);

private:
  mutable std::mutex mutex_;
  std::condition_variable goes_on_;
  std::atomic<bool> gathers_{false};
  bool paused_ = false;
  int steps_ = 0; ///< that are allowed
};

} // namespace meninas
