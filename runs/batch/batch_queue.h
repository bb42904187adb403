// The queue of a batch: its next task, if there is memory for it.
// The queue knows no threads; its callers lock it.
//
// Pictures of one scene file that share a solution form a group; a reference is a group of its own.
// Opening a group finds its light; while it is open its pictures are tasks.
// Pictures of open groups come first, then the next group. A group is admitted with
// the memory that its scene needs as long as it is open, and that its solve or the largest
// of its pictures needs beyond that, so that the group opened last can always go on.
#pragma once

#include "runs/batch/scene_work.h"

#include <chrono>
#include <span>

namespace meninas {

struct BatchTask {
  std::size_t group = 0;
  std::size_t picture = 0; ///< the one to make; of an opening any of the group
  bool opening = false;
  std::uint64_t memory = 0; ///< reserved until the task ends
};

/// A picture that cannot be made within the limit, and why.
struct RefusedPicture {
  std::size_t picture = 0;
  std::string reason;
};

class BatchQueue {
public:
  using Clock = std::chrono::steady_clock;

  /// `to_make`: indices of pictures without a problem.
  /// `memory_before`: what the process has without any task.
  BatchQueue(std::span<const BatchPicture> pictures, std::span<const std::size_t> to_make,
             std::uint64_t memory_before, std::uint64_t memory_limit);

  /// Nothing when there is no memory,
  /// when other processes are at all that is left, or when all has been begun.
  std::optional<BatchTask> next(Clock::time_point now, std::uint64_t resident_memory);
  /// Pictures found too big by `next` since the last call: they are over.
  std::vector<RefusedPicture> take_refused();

  // The end of a task: exactly one of these is called for each.
  void opened(const BatchTask& task, SceneLight light);
  void not_opened(const BatchTask& task, Clock::time_point again);
  std::vector<std::size_t>
  failed_to_open(const BatchTask& task); ///< the pictures that fail with it
  void made(const BatchTask& task);
  void held(const BatchTask& task, Clock::time_point again);

  /// Null for a reference. Stays where it is as long as the group has unfinished pictures.
  const LitScene* light(const BatchTask& task) const;
  /// Groups whose light is still to be found.
  std::size_t closed_groups() const;
  bool is_over() const;

private:
  enum class State { closed, opening, open, over };
  struct Group {
    std::vector<std::size_t> waiting; ///< pictures to be begun, the next one last
    std::size_t unfinished = 0;
    State state = State::closed;
    std::unique_ptr<SceneLight> light;
    std::uint64_t scene_memory = 0, task_memory = 0;
    std::size_t held_in_a_row = 0;
    Clock::time_point not_before = {}; ///< another process is at it
  };

  void add(std::size_t picture, Group& group);
  std::optional<BatchTask> next_picture(Clock::time_point now, std::uint64_t resident_memory);
  std::optional<BatchTask> next_opening(Clock::time_point now, std::uint64_t resident_memory);
  bool fits(std::uint64_t bytes, std::uint64_t resident_memory) const;
  bool is_too_big(const Group& group, std::uint64_t task_memory, std::size_t picture);
  void picture_over(Group& group);
  BatchTask begun(BatchTask task);
  Group& ended(const BatchTask& task);

  std::span<const BatchPicture> pictures_;
  std::vector<Group> groups_;
  std::vector<RefusedPicture> refused_;
  std::uint64_t before_, limit_, reserved_ = 0;
  std::size_t under_way_ = 0; ///< tasks
};

} // namespace meninas
