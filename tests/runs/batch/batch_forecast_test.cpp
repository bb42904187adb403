// How long a batch is going to take, where the answer is plain arithmetic.
#include "runs/batch/batch_forecast.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

/// 100 x 100 pixels of four samples: 40,000 rays.
BatchPicture picture(PictureMode mode, int width = 100) {
  BatchPicture result;
  result.size = {width, 100};
  result.request.settings.mode = mode;
  result.request.settings.samples = 4;
  return result;
}

const std::vector<BatchPicture> batch{
    picture(PictureMode::hybrid), picture(PictureMode::hybrid, 300),
    picture(PictureMode::reference), picture(PictureMode::reference)};

BatchForecast all_waiting() {
  BatchForecast forecast(batch);
  for (std::size_t k = 0; k < batch.size(); ++k) {
    forecast.waits(k);
  }
  return forecast;
}

TEST(BatchForecast, WithoutAnythingSeenThereIsNone) {
  EXPECT_FALSE(all_waiting().seconds_left({}, 5.0));
  BatchForecast forecast = all_waiting();
  forecast.waits_no_more(0);
  forecast.made(0, 1.0);
  EXPECT_TRUE(forecast.seconds_left({}, 1.0));
  EXPECT_FALSE(forecast.seconds_left({.pictures = {}, .solves = {}, .waiting_solves = 1}, 1.0));
}

TEST(BatchForecast, KindsOfPicturesHaveTheirOwnPace) {
  BatchForecast forecast = all_waiting();
  forecast.waits_no_more(0);
  forecast.made(0, 1.0);
  forecast.waits_no_more(2);
  forecast.made(2, 50.0);
  // Three times the rays of the first, and another reference; one task at a time.
  EXPECT_DOUBLE_EQ(forecast.seconds_left({}, 51.0).value(), 3.0 + 50.0);
  // Two at a time.
  EXPECT_DOUBLE_EQ(forecast.seconds_left({}, 25.5).value(), 0.5 * (3.0 + 50.0));
  // What was left to another process is begun after all.
  forecast.waits_no_more(3);
  EXPECT_DOUBLE_EQ(forecast.seconds_left({}, 51.0).value(), 3.0);
  forecast.waits(3);
  forecast.waits(3);
  EXPECT_DOUBLE_EQ(forecast.seconds_left({}, 51.0).value(), 3.0 + 50.0);
}

TEST(BatchForecast, PicturesUnderWayCount) {
  BatchForecast forecast = all_waiting();
  forecast.waits_no_more(2);
  // A quarter of a reference in ten seconds: thirty more, forty for the other one;
  // all else is expected to be like it, as nothing else is known.
  const TasksUnderWay now{.pictures = {{2, 10.0, 0.25}}, .solves = {}};
  EXPECT_DOUBLE_EQ(forecast.seconds_left(now, 10.0).value(), 30.0 + 40.0 + 4.0 * 40.0);
}

TEST(BatchForecast, SolvesAreExpectedToBeLikeThoseBefore) {
  BatchForecast forecast(batch);
  forecast.made(0, 1.0);
  forecast.solved(20.0);
  forecast.solved(10.0);
  // One has run for nine of fifteen seconds, one for longer than expected, one is to come.
  const TasksUnderWay now{.pictures = {}, .solves = {9.0, 20.0}, .waiting_solves = 1};
  EXPECT_DOUBLE_EQ(forecast.seconds_left(now, 60.0).value(), 6.0 + 15.0);
}

} // namespace
} // namespace meninas
