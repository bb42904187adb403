// The per-pixel test against a noisy reference:
// right pictures pass, biased ones do not; and what a change is called.
#include "image/metrics/changes.h"
#include "image/z_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meninas::test {
namespace {

constexpr int side = 64;

/// A ramp, and a reference of it with normally distributed
/// noise of 2 % and the variance that belongs to it.
struct Noisy {
  Image truth{side, side}, mean{side, side}, variance{side, side};
};

Noisy noisy_ramp() {
  Noisy result;
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = 0.1 + 0.01 * x + 0.3 * c, deviation = 0.02 * value;
        result.truth.at(x, y)[c] = static_cast<float>(value);
        result.mean.at(x, y)[c] = static_cast<float>(value + deviation * normal(engine));
        result.variance.at(x, y)[c] = static_cast<float>(deviation * deviation);
      }
  return result;
}

Image times(Image picture, float factor) {
  for (auto& pixel : picture.pixels)
    pixel *= factor;
  return picture;
}

TEST(ZTest, TheTruthGivesTheQuantileOfTheNormalDistribution) {
  const Noisy noisy = noisy_ramp();
  // 3.02 for one value in 400;
  // the quantile of 12,288 values has a standard error of sqrt(p / n) / density = 0.054.
  EXPECT_NEAR(z_figure(noisy.truth, noisy.mean, noisy.variance), 3.02, 4.0 * 0.054);
}

TEST(ZTest, ABiasOfOneStandardErrorShows) {
  // One-sided tail of 1/400 beyond 2.81, moved by the bias of 2 %.
  const Noisy noisy = noisy_ramp();
  EXPECT_NEAR(z_figure(times(noisy.truth, 1.02F), noisy.mean, noisy.variance), 3.81, 0.25);
}

TEST(ZTest, AFewPixelsWithoutVarianceDoNotDecide) {
  Noisy noisy = noisy_ramp();
  const double before = z_figure(noisy.truth, noisy.mean, noisy.variance);
  noisy.mean.at(7, 7) = glm::vec3(5.0F);
  noisy.variance.at(7, 7) = glm::vec3(0.0F);
  EXPECT_NEAR(z_figure(noisy.truth, noisy.mean, noisy.variance), before, 0.1);
}

TEST(ZTest, PixelsWithoutVarianceMustAgree) {
  const Image truth = noisy_ramp().truth, none(side, side);
  EXPECT_EQ(z_figure(truth, truth, none), 0.0);
  EXPECT_LT(z_figure(times(truth, 1.0F + 0x1p-12F), truth, none), 1.0); // rounded to half
  EXPECT_GT(z_figure(times(truth, 1.01F), truth, none), 10.0);
}

TEST(Changes, SayWhereAndHowMuch) {
  Image reference(80, 40);
  for (auto& pixel : reference.pixels)
    pixel = glm::vec3(0.5F);
  Image picture = reference;
  for (int y = 20; y < 25; ++y)
    for (int x = 30; x < 40; ++x)
      picture.at(x, y) = glm::vec3(0.75F);
  picture.at(33, 22) = glm::vec3(0.75F, 0.75F, 1.0F);
  EXPECT_EQ(describe_change(picture, reference, "W/m^2/sr"), "most at x 30-39, y 20-24: 50 % brighter; whole "
                                                 "picture 0.78 % brighter; worst pixel (33, 22): "
                                                 "(0.75, 0.75, 1), was (0.5, 0.5, 0.5) W/m^2/sr");
  EXPECT_THAT(describe_change(reference, picture, "W/m^2/sr"), testing::HasSubstr("33 % darker; whole"));
}

TEST(Changes, PicturesSmallerThanTheGridAndBlackOnes) {
  Image reference(3, 2);
  Image picture = reference;
  picture.at(2, 1) = glm::vec3(1.0F);
  EXPECT_THAT(describe_change(picture, reference, "W/m^2/sr"),
              testing::StartsWith("most at x 2-2, y 1-1: no longer black"));
}

} // namespace
} // namespace meninas::test
