#include "runs/report/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

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

void ProgressLine::report(std::string_view stage, double fraction) {
  if (style_ == ProgressStyle::none) {
    return;
  }
  // A thread that finds another one reporting goes on with its work.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) {
    return;
  }
  if (stage != stage_) {
    stage_ = stage;
    stage_begin_ = Clock::now();
    furthest_ = 0.0;
  }
  furthest_ = std::max(furthest_, fraction);
  if (is_due()) {
    show(line_for(furthest_));
  }
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

std::string ProgressLine::line_for(double fraction) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - stage_begin_).count();
  std::string line = fmt::format("{}: {:.0f} %", stage_, 100.0 * fraction);
  // Too little done says nothing about the rest.
  if (fraction > 0.02 && fraction < 1.0) {
    line += fmt::format(", {} left", readable_duration(elapsed * (1.0 - fraction) / fraction));
  }
  return line;
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
