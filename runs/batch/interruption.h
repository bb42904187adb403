// Ctrl-C and its kin (SIGINT, SIGTERM, SIGHUP),
// as something that happens to a run rather than to a process.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace meninas {

/// While it lives, these signals end up here instead of ending the process.
/// A SIGHUP that is ignored stays so (nohup); jobs that a script has put into
/// the background ignore SIGINT, but whoever sends it means it. One at a time.
class Interruption {
public:
  /// `handle` is called on a thread of its own, where it may do anything, once for each signal.
  explicit Interruption(std::function<void(int signal)> handle);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, signals.size()> before_{};
  std::atomic<bool> over_{false};
  std::thread waiting_;
};

} // namespace meninas
