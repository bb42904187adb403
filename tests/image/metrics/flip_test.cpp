// FLIP against closed forms, the authors' implementation and the laws it promises.
#include "image/metrics/flip.h"
#include "tests/image/picture_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// A picture from a function of (x, y, channel).
Image picture_of(int width, int height, auto value) {
  Image picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y)[c] = value(x, y, c);
  return picture;
}

Image flat(float r, float g, float b) {
  const glm::vec3 colour(r, g, b);
  return picture_of(40, 30, [&](int, int, int c) { return colour[c]; });
}

TEST(Flip, FlatPicturesDifferByColourAlone) {
  // Without features FLIP is the redistributed HyAB distance. White and black:
  // 100 in lightness, none in chroma. Green and blue have the largest distance of all,
  // Hunt-adjusted (87.73, -75.6, 73.0) and (32.30, 25.6, -34.8), so they give 1.
  const double largest = std::pow(203.3, 0.7);
  const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * largest) / (0.6 * largest);
  const Channel white_black = flip_map(flat(1, 1, 1), flat(0, 0, 0));
  for (const float value : white_black.values)
    EXPECT_NEAR(value, expected, 1e-4); // the colours above have three digits
  for (const float value : flip_map(flat(0, 1, 0), flat(0, 0, 1)).values)
    EXPECT_NEAR(value, 1.0, 1e-6);
}

TEST(Flip, AsTheAuthorsCompute) {
  // Means that the authors' C++ implementation (version 1.7,
  // 67 pixels per degree) gives for the same pictures. It works in floats throughout,
  // which is worth a few 1e-5 where the derivative of the powers is infinite.
  const auto waves = [](float gain) {
    return picture_of(96, 70, [=](int x, int y, int c) {
      const double phase = 0.1 * x * (c + 1) + 0.07 * y;
      return std::min(gain * (0.5F + 0.4F * static_cast<float>(std::sin(phase))), 1.0F);
    });
  };
  EXPECT_NEAR(mean_of(flip_map(waves(1.05F), waves(1.0F))), 0.128779, 1e-5);

  const auto boxes = [](int shift) {
    return picture_of(96, 70, [=](int x, int y, int c) {
      return std::min(static_cast<float>(((x + shift) / 16 + y / 16) % 2) * 0.8F +
                          0.1F * static_cast<float>(c),
                      1.0F);
    });
  };
  EXPECT_NEAR(mean_of(flip_map(boxes(1), boxes(0))), 0.138662, 3e-5);
}

TEST(Flip, GreyAgainstGreenAsTheAuthorsCompute) {
  EXPECT_NEAR(mean_of(flip_map(flat(0.2F, 0.9F, 0.2F), flat(0.2F, 0.2F, 0.2F))), 0.967287, 3e-5);
}

TEST(Flip, LiesBetweenZeroAndOneAndIsSymmetric) {
  const Image a = random_picture(50, 40, 1), b = random_picture(50, 40, 2);
  const Channel ab = flip_map(a, b), ba = flip_map(b, a);
  EXPECT_EQ(ab.values, ba.values);
  const auto [least, most] = std::ranges::minmax(ab.values);
  EXPECT_GE(least, 0.0F);
  EXPECT_LE(most, 1.0F);
  EXPECT_GT(most, 0.5F);
  EXPECT_EQ(mean_of(flip_map(a, a)), 0.0);
}

TEST(Flip, ADifferenceIsSeenAroundItsPlaceOnly) {
  // Filters reach ten pixels at 67 pixels per degree.
  const Image reference = flat(0.5F, 0.5F, 0.5F);
  Image picture = reference;
  picture.at(20, 15) = glm::vec3(1.0F);
  const Channel map = flip_map(picture, reference);
  EXPECT_GT(map.at(20, 15), 0.1F);
  EXPECT_EQ(map.at(20 + 11, 15), 0.0F);
  EXPECT_EQ(map.at(20, 15 - 11), 0.0F);
  EXPECT_NEAR(map.at(20 + 3, 15), map.at(20 - 3, 15), 1e-5); // the filters are even
  EXPECT_NEAR(map.at(20 + 3, 15), map.at(20, 15 + 3), 1e-5); // and isotropic
}

TEST(Flip, FurtherAwayLessIsSeen) {
  const Image reference = flat(0.5F, 0.5F, 0.5F);
  const Image noise = picture_of(
      40, 30, [](int x, int y, int) { return 0.5F + ((x + y) % 2 == 0 ? 0.1F : -0.1F); });
  EXPECT_GT(mean_of(flip_map(noise, reference, {.pixels_per_degree = 30.0})),
            2.0 * mean_of(flip_map(noise, reference, {.pixels_per_degree = 120.0})));
}

} // namespace
} // namespace meninas::test
