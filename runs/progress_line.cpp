#include "runs/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace meninas {

ProgressStyle progress_style(std::FILE* stream) {
  return isatty(fileno(stream)) != 0 ? ProgressStyle::terminal : ProgressStyle::log;
}

static std::string duration(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 60 ? fmt::format("{} s", whole)
                    : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

void ProgressLine::report(std::string_view stage, double fraction) {
  if (style_ == ProgressStyle::none) {
    return;
  }
  // A thread that finds another one reporting goes on with its work.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) {
    return;
  }
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_begin_ = now;
    furthest_ = 0.0;
  }
  furthest_ = std::max(furthest_, fraction);
  const auto pause = style_ == ProgressStyle::terminal ? std::chrono::milliseconds(100)
                                                       : std::chrono::milliseconds(5000);
  if (now - last_shown_ >= pause) {
    last_shown_ = now;
    show(furthest_);
  }
}

void ProgressLine::show(double fraction) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - stage_begin_).count();
  std::string line = fmt::format("{}: {:.0f} %", stage_, 100.0 * fraction);
  // Too little done says nothing about the rest.
  if (fraction > 0.02 && fraction < 1.0) {
    line += fmt::format(", {} left", duration(elapsed * (1.0 - fraction) / fraction));
  }
  if (style_ == ProgressStyle::terminal) {
    fmt::print(stream_, "\r{}\x1b[K", line);
    std::fflush(stream_);
    visible_ = true;
  } else {
    fmt::print(stream_, "meninas: {}\n", line);
  }
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (visible_) {
    fmt::print(stream_, "\r\x1b[K");
    std::fflush(stream_);
    visible_ = false;
  }
}

} // namespace meninas
