// The order of tasks, and the memory they may have, without threads and scenes:
// light is a value like any other here.
#include "runs/batch/batch_queue.h"
#include "runs/steering/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace meninas {
namespace {

using Clock = BatchQueue::Clock;

const Clock::time_point now{std::chrono::seconds(100)};
const auto later = now + std::chrono::seconds(1);
constexpr std::uint64_t unlimited = std::uint64_t{1} << 50;

BatchPicture picture(const std::string& key, int width = 100) {
  BatchPicture result;
  result.scene = key + ".glb";
  result.facts = std::make_shared<const SceneFacts>(
      SceneFacts{.cameras = {},
                 .bounds = {},
                 .sizes = {.vertices = 100, .triangles = 50, .sides = 50, .area = 10.0}});
  result.size = {width, 100};
  result.request.settings.quality = Quality::draft;
  result.key = key + "-picture";
  result.solution_key = key;
  return result;
}

std::uint64_t memory_of_view(const BatchPicture& picture) {
  return view_memory(picture.facts->sizes, picture.request.settings, picture.size);
}

struct Queued {
  Queued(std::vector<BatchPicture> list, std::uint64_t limit)
      : pictures(std::move(list)), all(pictures.size()) {
    std::iota(all.begin(), all.end(), std::size_t{0});
    queue.emplace(pictures, all, 0, limit);
  }
  std::optional<BatchTask> next(Clock::time_point when = now, std::uint64_t resident_memory = 0) {
    return queue->next(when, resident_memory);
  }

  std::vector<BatchPicture> pictures;
  std::vector<std::size_t> all;
  std::optional<BatchQueue> queue;
};

TEST(BatchQueue, AGroupIsOpenedOnceAndItsPicturesFollowInOrder) {
  Queued batch({picture("a"), picture("b"), picture("a")}, unlimited);
  const auto a = batch.next(), b = batch.next();
  ASSERT_TRUE(a && a->opening && b && b->opening);
  EXPECT_NE(a->group, b->group);
  EXPECT_FALSE(batch.next()) << "nothing is open yet";
  batch.queue->opened(*a, {});
  const auto first = batch.next(), second = batch.next();
  EXPECT_EQ(first->picture, 0);
  EXPECT_EQ(second->picture, 2);
  EXPECT_FALSE(batch.next());
  batch.queue->made(*first);
  batch.queue->made(*second);
  EXPECT_EQ(batch.queue->light(*a), nullptr) << "light is let go of with the last picture";
  EXPECT_THAT(batch.queue->failed_to_open(*b), testing::ElementsAre(1));
  EXPECT_TRUE(batch.queue->is_over());
}

TEST(BatchQueue, WhatOthersAreAtIsLeftForLater) {
  Queued batch({picture("a"), picture("a")}, unlimited);
  const auto opening = batch.next();
  batch.queue->not_opened(*opening, later);
  EXPECT_FALSE(batch.next());
  const auto again = batch.next(later);
  ASSERT_TRUE(again && again->opening);
  batch.queue->opened(*again, {});
  const auto held = batch.next(later);
  EXPECT_EQ(held->picture, 0);
  batch.queue->held(*held, later + std::chrono::seconds(1));
  const auto other = batch.next(later);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->picture, 1) << "the others come first";
  batch.queue->made(*other);
  const auto retried = batch.next(later);
  ASSERT_TRUE(retried);
  EXPECT_EQ(retried->picture, 0);
  batch.queue->held(*retried, later + std::chrono::seconds(1));
  EXPECT_FALSE(batch.next(later)) << "all that is left is held";
  EXPECT_TRUE(batch.next(later + std::chrono::seconds(1)));
}

TEST(BatchQueue, WhatIsTooBigIsRefusedAndTheRestIsMade) {
  const BatchPicture large = picture("a", 100'000);
  const std::uint64_t scene = scene_memory(large.facts->sizes, large.request.settings),
                      solve = solve_memory(large.facts->sizes, large.request.settings);
  Queued batch({picture("a"), large}, scene + std::max(solve, memory_of_view(large) - 1));
  const auto opening = batch.next();
  ASSERT_TRUE(opening);
  batch.queue->opened(*opening, {});
  const auto small = batch.next();
  ASSERT_TRUE(small);
  EXPECT_EQ(small->picture, 0);
  EXPECT_FALSE(batch.next());
  const auto refused = batch.queue->take_refused();
  ASSERT_EQ(refused.size(), 1);
  EXPECT_EQ(refused[0].picture, 1);
  EXPECT_THAT(refused[0].reason, testing::HasSubstr("a.glb: needs about"));
  batch.queue->made(*small);
  EXPECT_TRUE(batch.queue->is_over());
}

TEST(BatchQueue, AGroupThatCannotBeSolvedIsRefused) {
  Queued batch({picture("a"), picture("a")}, 1000);
  EXPECT_FALSE(batch.next());
  EXPECT_EQ(batch.queue->take_refused().size(), 2);
  EXPECT_TRUE(batch.queue->is_over());
}

// Whatever the order in which tasks end, and whatever freed memory the process keeps:
// the limit holds, and everything gets made.
TEST(BatchQueue, TheLimitHoldsAndNothingStarves) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<BatchPicture> pictures;
    for (int k = 0; k < 12; ++k) {
      pictures.push_back(picture(std::string(1, static_cast<char>('a' + random() % 4)),
                                 100 + static_cast<int>(random() % 20'000)));
    }
    const BatchPicture& any = pictures.front();
    const std::uint64_t scene = scene_memory(any.facts->sizes, any.request.settings),
                        solve = solve_memory(any.facts->sizes, any.request.settings);
    std::uint64_t largest = 0;
    for (const BatchPicture& one : pictures) {
      largest = std::max({largest, memory_of_view(one), solve});
    }
    const std::uint64_t limit = scene + largest + random() % (2 * largest);
    Queued batch(pictures, limit);
    std::vector<BatchTask> running;
    std::size_t made = 0, open = 0;
    const auto used = [&] {
      std::uint64_t bytes = open * scene;
      for (const BatchTask& task : running) {
        bytes += task.memory;
      }
      return bytes;
    };
    while (!batch.queue->is_over()) {
      while (auto task = batch.next(now, random() % (2 * limit))) {
        running.push_back(*task);
        open += task->opening ? 1 : 0;
        ASSERT_LE(used(), limit);
      }
      ASSERT_FALSE(running.empty()) << "nothing runs and nothing is admitted";
      const auto ended = running.begin() + static_cast<std::ptrdiff_t>(random() % running.size());
      if (ended->opening) {
        batch.queue->opened(*ended, {});
      } else {
        batch.queue->made(*ended);
        ++made;
        open -= batch.queue->light(*ended) == nullptr ? 1 : 0;
      }
      running.erase(ended);
    }
    EXPECT_EQ(made, pictures.size());
  }
}

} // namespace
} // namespace meninas
