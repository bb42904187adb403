// The progress of a run on standard error:
// one line that is written over on a terminal, a plain line now and then in a log.
#pragma once

#include "runs/report/run_progress.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace meninas {

enum class ProgressStyle { none, terminal, log };

/// Writes a text for people. If it cannot be written, on a full disk or a closed stream, the text is lost, and the
/// run goes on.
void tell(std::FILE* stream, const std::string& text);

/// A terminal where the stream is one, a log otherwise.
ProgressStyle progress_style(std::FILE* stream);

/// "12 s", "3 min 05 s"
std::string readable_duration(double seconds);

/// Safe to be told from any thread.
class ProgressLine {
public:
  ProgressLine(std::FILE* stream, ProgressStyle style) : stream_(stream), style_(style) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// The stages of the run that begins.
  void begin(const std::vector<RunStage>& stages);
  void report(std::string_view stage, double fraction);
  /// A line that says how far things are by itself.
  void report(const std::string& line);
  /// Takes the line away, so that something else can be written there.
  void clear();

private:
  using Clock = std::chrono::steady_clock;
  bool is_due();
  double now() const;
  /// Shows how far the run is between reports, for stages that make none.
  void keep_moving();
  std::string line() const;
  void show(const std::string& line);

  std::FILE* stream_;
  ProgressStyle style_;
  std::mutex mutex_;
  RunProgress progress_;
  Clock::time_point last_shown_ = Clock::now();
  bool visible_ = false;
  std::condition_variable_any wake_;
  std::jthread clock_; ///< that keeps it moving, from the first report on
};

} // namespace meninas
