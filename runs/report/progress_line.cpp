#include "runs/report/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace meninas {

void tell(std::FILE* stream, const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
}

ProgressStyle progress_style(std::FILE* stream) {
  return isatty(fileno(stream)) != 0 ? ProgressStyle::terminal : ProgressStyle::log;
}

std::string readable_duration(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 60 ? fmt::format("{} s", whole)
                    : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

ProgressLine::~ProgressLine() {
  clock_ = {};
  clear();
}

double ProgressLine::now() const {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void ProgressLine::begin(const std::vector<RunStage>& stages) {
  const std::lock_guard lock(mutex_);
  progress_.begin(stages, now());
}

void ProgressLine::report(std::string_view stage, double fraction) {
  if (style_ == ProgressStyle::none) {
    return;
  }
  // A thread that finds another one reporting goes on with its work, but for the end of a stage: with
  // that the next one begins.
  std::unique_lock lock(mutex_, std::defer_lock);
  if (fraction >= 1.0) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;
  }
  progress_.report(stage, fraction, now());
  if (is_due()) {
    show(line());
  }
  if (!clock_.joinable()) {
    keep_moving();
  }
}

void ProgressLine::keep_moving() {
  clock_ = std::jthread([this](const std::stop_token& stop) {
    constexpr auto pause = std::chrono::milliseconds(250);
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      wake_.wait_for(lock, stop, pause, [] { return false; });
      if (!stop.stop_requested() && progress_.state(now()).done < 1.0 && is_due()) {
        show(line());
      }
    }
  });
}

void ProgressLine::report(const std::string& line) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (style_ != ProgressStyle::none && lock && is_due()) {
    show(line);
  }
}

bool ProgressLine::is_due() {
  const auto now = Clock::now();
  const auto pause = style_ == ProgressStyle::terminal ? std::chrono::milliseconds(100)
                                                       : std::chrono::milliseconds(5000);
  if (now - last_shown_ < pause) {
    return false;
  }
  last_shown_ = now;
  return true;
}

/// "43 %, 5 s left: interpolation", on a terminal behind a bar.
std::string ProgressLine::line() const {
  const RunState state = progress_.state(now());
  std::string line = fmt::format("{:.0f} %", std::floor(100.0 * state.done));
  if (state.seconds_left) {
    line += fmt::format(", {} left", readable_duration(*state.seconds_left));
  }
  line += ": " + state.stage;
  if (style_ != ProgressStyle::terminal) {
    return line;
  }
  constexpr int width = 24;
  const auto full = static_cast<std::size_t>(width * state.done);
  return fmt::format("[{:<{}}] {}", std::string(full, '#'), width, line);
}

void ProgressLine::show(const std::string& line) {
  if (style_ == ProgressStyle::terminal) {
    tell(stream_, fmt::format("\r{}\x1b[K", line));
    std::fflush(stream_);
    visible_ = true;
  } else {
    tell(stream_, fmt::format("meninas: {}\n", line));
  }
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (visible_) {
    tell(stream_, "\r\x1b[K");
    std::fflush(stream_);
    visible_ = false;
  }
}

} // namespace meninas
