// Which pieces of work are tried where a time is foretold: never more than a tenth of a second of them in a row.
#include "scenes/seconds_of_one.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace meninas {
namespace {

using Rounds = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(SecondsOfOne, WhatTakesLongIsTriedOnceAndNoMore) {
  Rounds rounds;
  const double seconds = seconds_of_one(1024, 2, [&](std::size_t first, std::size_t last) {
    rounds.emplace_back(first, last);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
  });
  EXPECT_EQ(rounds, (Rounds{{0, 2}, {0, 2}})) << "once to fill tables, once with the watch";
  EXPECT_GE(seconds, 0.5 * 0.15) << "two pieces a round, each half of it at least: a sleep is never shorter";
}

TEST(SecondsOfOne, WhatIsQuickIsTriedInRoundsThatDouble) {
  Rounds rounds;
  seconds_of_one(21, 3, [&](std::size_t first, std::size_t last) { rounds.emplace_back(first, last); });
  ASSERT_GE(rounds.size(), 2U);
  // A busy machine may end it sooner, so that only the beginning is sure.
  const Rounds all{{0, 3}, {0, 3}, {3, 6}, {6, 12}, {12, 21}};
  ASSERT_LE(rounds.size(), all.size());
  EXPECT_EQ(rounds, Rounds(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rounds.size())));
}

TEST(SecondsOfOne, NothingTakesNoTime) {
  EXPECT_EQ(seconds_of_one(0, 1, [](std::size_t first, std::size_t last) { EXPECT_EQ(first, last); }), 0.0);
}

} // namespace
} // namespace meninas
