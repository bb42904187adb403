// The pictures of a batch, made side by side.
//
// At most as many tasks (batch_queue.h) run as there are threads;
// threads that have no task of their own help with the rays of the tasks that run.
// So small pictures are made side by side, and a large one, or a solve,
// has all threads that nothing else needs. Tasks of other processes are left for later.
#pragma once

#include "runs/batch/scene_work.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <span>

namespace meninas {

/// The progress of a batch.
struct BatchProgress {
  std::size_t pictures = 0, done = 0, failed = 0;
  std::size_t running = 0, solving = 0; ///< tasks
  std::optional<double> seconds_left;   ///< as soon as something can be said (batch_forecast.h)
  std::uint64_t rays = 0;               ///< traced so far; of pictures under way their camera rays
};

/// Every function may be empty, and is called from any thread.
struct BatchWorkEvents {
  RunEvents run; ///< of the tasks; warnings name their scene
  std::function<void(const BatchPicture&, const PictureResult&)> finished;
  std::function<void(const BatchProgress&)> progress;
};

/// The outcome of pass one for a group of pictures.
struct SolveResult {
  std::string scene, key;
  bool solved = false; ///< false: read from the cache
  double seconds = 0.0;
  RunFigures figures;
};

class BatchWork {
public:
  BatchWork(const BatchFolder& folder, std::span<const BatchPicture> pictures, int threads,
            std::uint64_t memory_limit, BatchWorkEvents events);
  ~BatchWork();

  /// Returns when every picture is done or has failed,
  /// or when it was stopped and no task runs any more.
  void run();

  /// Begins nothing any more. From any thread.
  void stop();
  /// Waits for the running tasks, no longer than that; whether they have ended.
  bool wait_for_end(std::chrono::milliseconds patience);
  /// Waits until no file is under way, and lets none begin any more as long as the result lives.
  std::unique_lock<std::shared_timed_mutex> stop_writing(std::chrono::milliseconds patience);

  /// By picture; what they are now.
  std::vector<PictureResult> results() const;
  std::vector<SolveResult> solves() const;
  std::uint64_t rays() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace meninas
