#include "runs/batch/batch_queue.h"

#include "runs/steering/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace meninas {

static std::uint64_t memory_of_view(const BatchPicture& picture) {
  return view_memory(picture.facts->sizes, picture.request.settings, picture.size);
}

BatchQueue::BatchQueue(std::span<const BatchPicture> pictures, std::span<const std::size_t> to_make,
                       std::uint64_t memory_before, std::uint64_t memory_limit)
    : pictures_(pictures), before_(memory_before), limit_(memory_limit) {
  // Copies of a scene share their solution by way of the cache:
  // one that vanishes does not take the others with it.
  std::map<std::pair<std::string, std::filesystem::path>, std::size_t> by_key;
  for (const std::size_t picture : to_make) {
    const bool reference = pictures[picture].solution_key.empty();
    const auto& key = reference ? pictures[picture].key : pictures[picture].solution_key;
    const auto [entry, is_new] =
        by_key.emplace(std::pair(key, pictures[picture].scene), groups_.size());
    if (is_new) {
      groups_.emplace_back();
    }
    add(picture, groups_[entry->second]);
  }
  for (Group& group : groups_) {
    std::ranges::reverse(group.waiting);
  }
}

void BatchQueue::add(std::size_t picture, Group& group) {
  const BatchPicture& added = pictures_[picture];
  if (added.solution_key.empty()) {
    group.state = State::open;
  } else if (group.waiting.empty()) {
    RunSettings settings = added.request.settings;
    if (!settings.lamp_factors.empty() || settings.lamp_layers)
      settings.lamps = LampGrouping::node; // one solution for all their states
    group.scene_memory = scene_memory(added.facts->sizes, settings);
    group.task_memory = solve_memory(added.facts->sizes, settings);
  }
  // A picture that is too big even alone does not keep the others from being made.
  const std::uint64_t view = memory_of_view(added);
  if (before_ + group.scene_memory + view <= limit_) {
    group.task_memory = std::max(group.task_memory, view);
  }
  group.waiting.push_back(picture);
  ++group.unfinished;
}

bool BatchQueue::fits(std::uint64_t bytes, std::uint64_t resident_memory) const {
  // With nothing under way, what is resident beyond what is expected was freed but not given back,
  // and is there to be used again.
  const std::uint64_t expected = before_ + reserved_;
  const std::uint64_t used = under_way_ == 0 ? expected : std::max(expected, resident_memory);
  return used + bytes <= limit_;
}

bool BatchQueue::is_too_big(const Group& group, std::uint64_t task_memory, std::size_t picture) {
  const std::uint64_t needed = before_ + group.scene_memory + task_memory;
  if (needed <= limit_) {
    return false;
  }
  refused_.push_back({picture, fmt::format("{}: needs about {}, more than the memory limit of {}",
                                           pictures_[picture].scene.string(),
                                           readable_bytes(needed), readable_bytes(limit_))});
  return true;
}

std::optional<BatchTask> BatchQueue::next(Clock::time_point now, std::uint64_t resident_memory) {
  if (auto task = next_picture(now, resident_memory)) {
    return task;
  }
  return next_opening(now, resident_memory);
}

std::optional<BatchTask> BatchQueue::next_picture(Clock::time_point now,
                                                  std::uint64_t resident_memory) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    while (group.state == State::open && !group.waiting.empty() && now >= group.not_before) {
      const std::size_t picture = group.waiting.back();
      const std::uint64_t memory = memory_of_view(pictures_[picture]);
      if (is_too_big(group, memory, picture)) {
        group.waiting.pop_back();
        picture_over(group);
        continue;
      }
      if (!fits(memory, resident_memory)) {
        break;
      }
      group.waiting.pop_back();
      return begun({g, picture, false, memory});
    }
  }
  return std::nullopt;
}

std::optional<BatchTask> BatchQueue::next_opening(Clock::time_point now,
                                                  std::uint64_t resident_memory) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    if (group.state != State::closed || now < group.not_before) {
      continue;
    }
    while (!group.waiting.empty() && is_too_big(group, group.task_memory, group.waiting.back())) {
      group.waiting.pop_back();
      picture_over(group);
    }
    if (group.state == State::over) {
      continue;
    }
    // The first in line is not overtaken: large groups would wait for ever.
    if (!fits(group.scene_memory + group.task_memory, resident_memory)) {
      return std::nullopt;
    }
    group.state = State::opening;
    reserved_ += group.scene_memory;
    return begun({g, group.waiting.back(), true, group.task_memory});
  }
  return std::nullopt;
}

std::vector<RefusedPicture> BatchQueue::take_refused() { return std::exchange(refused_, {}); }

BatchTask BatchQueue::begun(BatchTask task) {
  reserved_ += task.memory;
  ++under_way_;
  return task;
}

BatchQueue::Group& BatchQueue::ended(const BatchTask& task) {
  reserved_ -= task.memory;
  --under_way_;
  return groups_[task.group];
}

void BatchQueue::opened(const BatchTask& task, SceneLight light) {
  Group& group = ended(task);
  group.light = std::make_unique<SceneLight>(std::move(light));
  group.state = State::open;
}

void BatchQueue::not_opened(const BatchTask& task, Clock::time_point again) {
  Group& group = ended(task);
  reserved_ -= group.scene_memory;
  group.state = State::closed;
  group.not_before = again;
}

std::vector<std::size_t> BatchQueue::failed_to_open(const BatchTask& task) {
  Group& group = ended(task);
  reserved_ -= group.scene_memory;
  group.state = State::over;
  const std::vector<std::size_t> failed(group.waiting.rbegin(), group.waiting.rend());
  group.waiting.clear();
  group.unfinished = 0;
  return failed;
}

void BatchQueue::made(const BatchTask& task) {
  Group& group = ended(task);
  group.held_in_a_row = 0;
  picture_over(group);
}

void BatchQueue::held(const BatchTask& task, Clock::time_point again) {
  Group& group = ended(task);
  group.waiting.insert(group.waiting.begin(), task.picture);
  // The others of the group come first; when all have been tried in vain it is time to wait.
  if (++group.held_in_a_row >= group.waiting.size()) {
    group.held_in_a_row = 0;
    group.not_before = again;
  }
}

void BatchQueue::picture_over(Group& group) {
  if (--group.unfinished > 0) {
    return;
  }
  if (group.state == State::open) {
    reserved_ -= group.scene_memory;
  }
  group.state = State::over;
  group.light.reset();
}

const LitScene* BatchQueue::light(const BatchTask& task) const {
  const auto& light = groups_[task.group].light;
  return light ? &light->lit : nullptr;
}

std::size_t BatchQueue::closed_groups() const {
  const auto closed = std::ranges::count(groups_, State::closed, &Group::state);
  return static_cast<std::size_t>(closed);
}

bool BatchQueue::is_over() const {
  return std::ranges::all_of(groups_,
                             [](const Group& group) { return group.state == State::over; });
}

} // namespace meninas
