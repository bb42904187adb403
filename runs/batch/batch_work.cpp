#include "runs/batch/batch_work.h"

#include "runs/batch/batch_forecast.h"
#include "runs/batch/batch_queue.h"
#include "runs/steering/memory.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <condition_variable>
#include <map>
#include <new>
#include <thread>

namespace meninas {
namespace {

using Clock = BatchQueue::Clock;

/// Before what another process is at is looked at again.
constexpr auto pause = std::chrono::milliseconds(50);

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The result of a task that ends with an exception.
PictureResult failure(const std::string& what, int code) {
  PictureResult result{PictureStatus::failed, {}};
  result.record.error = what;
  result.record.exit_code = code;
  return result;
}

/// Runs a task's work; whatever it throws is a failure of this task alone.
template <typename Work>
std::optional<PictureResult> guarded(Work work) {
  constexpr int code = static_cast<int>(ExitCode::failed_output);
  try {
    work();
    return std::nullopt;
  } catch (const UserError& error) {
    return failure(error.what(), static_cast<int>(error.code()));
  } catch (const std::bad_alloc&) {
    return failure("out of memory", code);
  } catch (const std::exception& error) {
    return failure(fmt::format("internal error: {}", error.what()), code);
  }
}

} // namespace

struct BatchWork::Impl {
  Impl(const BatchFolder& at, std::span<const BatchPicture> all, int thread_count,
       std::uint64_t memory_limit, BatchWorkEvents told)
      : folder(at), pictures(all), threads(thread_count), events(std::move(told)),
        results(all.size()), under_way(all.size()), forecast(all),
        queue(all, begin_results(), resident_memory_bytes(), memory_limit) {}

  const BatchFolder& folder;
  std::span<const BatchPicture> pictures;
  int threads;
  BatchWorkEvents events;

  mutable std::mutex mutex; ///< of everything below
  std::vector<PictureResult> results;
  std::vector<std::atomic<float>> under_way; ///< by picture: the share of it that is rendered
  std::map<std::size_t, Clock::time_point> being_made, being_lit; ///< since when, by picture
  std::size_t done_count = 0, failed_count = 0;
  BatchForecast forecast;
  Clock::time_point begin = Clock::now();
  BatchQueue queue;
  std::vector<SolveResult> solves;
  std::size_t running = 0, opening = 0;
  std::uint64_t rays = 0;
  bool stopped = false;

  std::condition_variable task_ended;
  std::shared_timed_mutex writing;
  std::atomic<Clock::rep> last_told = 0;
  tbb::task_group tasks;

  std::vector<std::size_t> begin_results();
  void begin_tasks();
  void run_task(const BatchTask& task);
  void open(const BatchTask& task);
  void make(const BatchTask& task);
  void finish(std::size_t picture, PictureResult result);
  void tell();
  BatchProgress progress() const;
  RunEvents events_of(std::size_t picture);
};

/// What is known of every picture before the work; returns those that have to be made.
std::vector<std::size_t> BatchWork::Impl::begin_results() {
  std::vector<std::optional<PictureRecord>> records(pictures.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t k) {
    if (!pictures[k].problem) {
      records[k] = folder.done(pictures[k]);
    }
  });
  std::vector<std::size_t> to_make;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    if (const auto& problem = pictures[k].problem) {
      finish(k, failure(problem->what, problem->exit_code));
    } else if (records[k]) {
      finish(k, {PictureStatus::found, std::move(*records[k])});
    } else {
      to_make.push_back(k);
      forecast.waits(k);
    }
  }
  return to_make;
}

/// With the mutex held.
void BatchWork::Impl::begin_tasks() {
  while (running < static_cast<std::size_t>(threads) && !stopped) {
    const auto task = queue.next(Clock::now(), resident_memory_bytes());
    for (const auto& [picture, reason] : queue.take_refused()) {
      finish(picture, failure(reason, static_cast<int>(ExitCode::failed_output)));
    }
    if (!task) {
      return;
    }
    ++running;
    opening += task->opening ? 1 : 0;
    tasks.run([this, task = *task] {
      // Waiting for its own rays a thread must not begin another task,
      // which would have to end first.
      tbb::this_task_arena::isolate([&] { run_task(task); });
      const std::lock_guard lock(mutex);
      --running;
      opening -= task.opening ? 1 : 0;
      begin_tasks();
      task_ended.notify_all();
    });
  }
}

void BatchWork::Impl::run_task(const BatchTask& task) {
  if (task.opening) {
    open(task);
  } else {
    make(task);
  }
  tell();
}

void BatchWork::Impl::open(const BatchTask& task) {
  const BatchPicture& picture = pictures[task.picture];
  const auto begun = Clock::now();
  {
    const std::lock_guard lock(mutex);
    being_lit.emplace(task.picture, begun);
  }
  std::optional<SceneLight> light;
  const auto problem =
      guarded([&] { light = find_light(folder, picture, events_of(task.picture)); });

  const double seconds = seconds_since(begun);
  const std::lock_guard lock(mutex);
  being_lit.erase(task.picture);
  if (problem) {
    for (const std::size_t failed : queue.failed_to_open(task)) {
      finish(failed, *problem);
    }
  } else if (!light) {
    queue.not_opened(task, Clock::now() + pause);
  } else {
    if (light->solved) { // otherwise the figures tell of an earlier run
      rays += light->figures.rays.form_factor + light->figures.rays.shadow;
    }
    solves.push_back(
        {picture.scene.string(), picture.solution_key, light->solved, seconds, light->figures});
    forecast.solved(seconds);
    queue.opened(task, std::move(*light));
  }
}

void BatchWork::Impl::make(const BatchTask& task) {
  const LitScene* light = nullptr;
  {
    const std::lock_guard lock(mutex);
    light = queue.light(task);
    being_made.emplace(task.picture, Clock::now());
    forecast.waits_no_more(task.picture);
  }
  PictureResult result;
  if (auto problem = guarded([&] {
        result =
            make_picture(folder, pictures[task.picture], light, writing, events_of(task.picture));
      })) {
    result = std::move(*problem);
  }
  const std::lock_guard lock(mutex);
  being_made.erase(task.picture);
  if (result.status == PictureStatus::held) {
    queue.held(task, Clock::now() + pause);
    forecast.waits(task.picture);
    return;
  }
  if (result.status == PictureStatus::made) {
    rays += result.record.rays;
    forecast.made(task.picture, result.record.seconds);
  }
  queue.made(task);
  finish(task.picture, std::move(result));
}

void BatchWork::Impl::finish(std::size_t k, PictureResult result) {
  results[k] = std::move(result);
  const bool is_failure = results[k].status == PictureStatus::failed;
  (is_failure ? failed_count : done_count) += 1;
  forecast.waits_no_more(k);
  if (is_failure && !pictures[k].problem) {
    // For the summaries of other processes; where nothing can be written there will be none.
    guarded([&] { folder.keep(pictures[k], results[k].record); });
  }
  if (events.finished) {
    events.finished(pictures[k], results[k]);
  }
}

void BatchWork::Impl::tell() {
  if (events.progress) {
    std::unique_lock lock(mutex);
    const BatchProgress now = progress();
    lock.unlock();
    events.progress(now);
  }
}

BatchProgress BatchWork::Impl::progress() const {
  BatchProgress now{.pictures = pictures.size(),
                    .done = done_count,
                    .failed = failed_count,
                    .running = running - opening,
                    .solving = opening,
                    .seconds_left = {},
                    .rays = rays};
  TasksUnderWay tasks_now{.pictures = {}, .solves = {}, .waiting_solves = queue.closed_groups()};
  for (const auto& [picture, since] : being_made) {
    const double share = under_way[picture];
    tasks_now.pictures.push_back({picture, seconds_since(since), share});
    now.rays += static_cast<std::uint64_t>(share * forecast.camera_rays(picture));
  }
  for (const auto& [picture, since] : being_lit) {
    tasks_now.solves.push_back(seconds_since(since));
  }
  now.seconds_left = forecast.seconds_left(tasks_now, seconds_since(begin));
  return now;
}

RunEvents BatchWork::Impl::events_of(std::size_t picture) {
  RunEvents result;
  const std::string scene = pictures[picture].scene.filename().string();
  result.warning = [this, scene](const std::string& text) {
    warn(events.run, scene + ": " + text);
  };
  result.progress = [this, picture](std::string_view stage, double fraction) {
    if (stage == "render" || stage == "paths") {
      under_way[picture] = static_cast<float>(fraction);
    }
    constexpr Clock::duration often = std::chrono::milliseconds(100);
    const Clock::rep now = Clock::now().time_since_epoch().count();
    Clock::rep before = last_told;
    if (now - before >= often.count() && last_told.compare_exchange_strong(before, now)) {
      tell();
    }
  };
  return result;
}

BatchWork::BatchWork(const BatchFolder& folder, std::span<const BatchPicture> pictures, int threads,
                     std::uint64_t memory_limit, BatchWorkEvents events)
    : impl_(std::make_unique<Impl>(folder, pictures, threads, memory_limit, std::move(events))) {}

BatchWork::~BatchWork() = default;

void BatchWork::run() {
  while (true) {
    {
      const std::lock_guard lock(impl_->mutex);
      impl_->begin_tasks();
    }
    impl_->tasks.wait();
    {
      const std::lock_guard lock(impl_->mutex);
      if (impl_->stopped || impl_->queue.is_over()) {
        return;
      }
    }
    // All that is left is held by other processes.
    std::this_thread::sleep_for(pause / 2);
  }
}

void BatchWork::stop() {
  const std::lock_guard lock(impl_->mutex);
  impl_->stopped = true;
}

bool BatchWork::wait_for_end(std::chrono::milliseconds patience) {
  std::unique_lock lock(impl_->mutex);
  return impl_->task_ended.wait_for(lock, patience, [&] { return impl_->running == 0; });
}

std::unique_lock<std::shared_timed_mutex>
BatchWork::stop_writing(std::chrono::milliseconds patience) {
  return {impl_->writing, patience};
}

std::vector<PictureResult> BatchWork::results() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->results;
}

std::vector<SolveResult> BatchWork::solves() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->solves;
}

std::uint64_t BatchWork::rays() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->rays;
}

} // namespace meninas
