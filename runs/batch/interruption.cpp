#include "runs/batch/interruption.h"

#include <chrono>

namespace meninas {

/// All that a signal's handler may touch.
static std::atomic<int> arrived{0};
static_assert(std::atomic<int>::is_always_lock_free);

static void note_arrival(int signal) { arrived = signal; }

Interruption::Interruption(std::function<void(int)> handle) {
  arrived = 0;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], nullptr, &before_[k]);
    const bool nohup = signals[k] == SIGHUP && before_[k].sa_handler == SIG_IGN;
    if (!nohup) {
      struct sigaction noted {};
      noted.sa_handler = note_arrival;
      noted.sa_flags = SA_RESTART;
      sigaction(signals[k], &noted, nullptr);
    }
  }
  waiting_ = std::thread([this, handle = std::move(handle)] {
    while (!over_) {
      if (const int signal = arrived.exchange(0)) {
        handle(signal);
      }
      // Short enough for the end of a run not to be felt.
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
}

Interruption::~Interruption() {
  over_ = true;
  waiting_.join();
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], &before_[k], nullptr);
  }
}

} // namespace meninas
