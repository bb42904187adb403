// The reference knows how wrong it is.
#include "tests/reference/tracing.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace meninas::test {
namespace {

using reference::ReferencePicture;
using reference::StoppedBy;

/// A room with a lamp, a mirror and a box.
Scene small_room() {
  Scene scene;
  add_room(scene, {0, 0, 0}, {3, 2.5, 4},
           {mirror(0.8), diffuse({0.6, 0.2, 0.2}), diffuse(0.5), diffuse(0.7),
            diffuse({0.2, 0.5, 0.3}), diffuse(0.6)});
  add_box(scene, "box", {1.2, 0.0, 1.0}, {2.0, 0.9, 1.7}, diffuse(0.4));
  add_polygon(scene, "lamp", {{0.5, 2.4, 0.5}, {2.5, 2.4, 0.5}, {2.5, 2.4, 3.5}, {0.5, 2.4, 3.5}},
              diffuse(0.0, 4.0));
  return scene;
}

ReferencePicture room_picture(const reference::ReferenceSettings& settings) {
  return traced_picture(small_room(), look_at({2.3, 1.3, 3.6}, {1.0, 1.0, 0.5}, 1.1), settings);
}

TEST(ReferenceStatistics, IndependentPicturesDifferByTheirVariance) {
  auto settings = tracing(24, 18, 512);
  const ReferencePicture a = room_picture(settings);
  settings.seed = 1;
  const ReferencePicture b = room_picture(settings);
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t k = 0; k < a.mean.pixels.size(); ++k) {
    const double variance = a.variance.pixels[k].g + b.variance.pixels[k].g;
    if (variance == 0.0)
      continue;
    const double z = (a.mean.pixels[k].g - b.mean.pixels[k].g) / std::sqrt(variance);
    sum += z;
    squares += z * z;
    ++count;
  }
  ASSERT_GT(count, 400.0);
  // The mean of so many z is known to 1 / sqrt(n), their mean square to sqrt(2 / n),
  // both times four; 32 batches make the latter 1.07.
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1.07, 4.0 * std::sqrt(2.0 / count));
}

TEST(ReferenceStatistics, StopsAtTheErrorThatIsAskedFor) {
  auto settings = tracing(16, 12, 1 << 20);
  settings.max_error = 0.02;
  const ReferencePicture picture = room_picture(settings);
  EXPECT_EQ(picture.stopped_by, StoppedBy::error);
  EXPECT_LE(picture.standard_error, 0.02);
  // One batch less was not enough; without a hurry it ends near what was asked for.
  EXPECT_GT(picture.standard_error, 0.015);
  // The error is the one of the picture.
  double variance = 0.0, mean = 0.0;
  for (std::size_t k = 0; k < picture.mean.pixels.size(); ++k)
    for (int band = 0; band < 3; ++band) {
      variance += picture.variance.pixels[k][band];
      mean += picture.mean.pixels[k][band];
    }
  const double values = 3.0 * double(picture.mean.pixels.size());
  EXPECT_NEAR(picture.standard_error, std::sqrt(variance / values) / (mean / values), 1e-6);
}

TEST(ReferenceStatistics, StopsAtSamplesAndInTime) {
  const ReferencePicture few = room_picture(tracing(4, 4, 48));
  EXPECT_EQ(few.stopped_by, StoppedBy::samples);
  EXPECT_EQ(few.samples, 48);
  auto hurried = tracing(4, 4, 1 << 20);
  hurried.max_seconds = 0.05;
  const ReferencePicture quick = room_picture(hurried);
  EXPECT_EQ(quick.stopped_by, StoppedBy::time);
  EXPECT_LT(quick.samples, 1 << 20);
  hurried.max_seconds = 1e-9;
  const ReferencePicture first = room_picture(hurried);
  EXPECT_EQ(first.stopped_by, StoppedBy::time);
  EXPECT_EQ(first.samples, 2) << "one sample and another one, whose difference is the error";
  EXPECT_GT(first.standard_error, 0.0);
}

TEST(ReferenceStatistics, SmallFirstBatchesLeaveTheMeanAndItsVarianceRight) {
  auto limited = tracing(24, 18, 64);
  limited.max_seconds = 1e6;
  const ReferencePicture a = room_picture(limited);
  EXPECT_EQ(a.samples, 64);
  const ReferencePicture truth = room_picture(tracing(24, 18, 4096));
  double squares = 0.0, count = 0.0;
  for (std::size_t k = 0; k < a.mean.pixels.size(); ++k) {
    const double variance = a.variance.pixels[k].g + truth.variance.pixels[k].g;
    if (variance == 0.0)
      continue;
    const double z = (a.mean.pixels[k].g - truth.mean.pixels[k].g) / std::sqrt(variance);
    squares += std::min(z * z, 16.0);
    ++count;
  }
  ASSERT_GT(count, 400.0);
  // Eight batches: z has the tails of Student's t with seven degrees of freedom, a mean square of 1.4.
  EXPECT_GT(squares / count, 0.6);
  EXPECT_LT(squares / count, 1.8);
}

TEST(ReferenceStatistics, TheSameBitsForAnyNumberOfThreads) {
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return room_picture(tracing(16, 12, 64));
  };
  const ReferencePicture one = with_threads(1), two = with_threads(2);
  EXPECT_TRUE(one.mean.pixels == two.mean.pixels);
  EXPECT_TRUE(one.variance.pixels == two.variance.pixels);
  EXPECT_EQ(one.rays.path_rays, two.rays.path_rays);
}

} // namespace
} // namespace meninas::test
