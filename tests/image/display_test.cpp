// The sRGB curve against its definition,
// and automatic exposure against what an eye would ask of it.
#include "image/display.h"
#include "tests/image/picture_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meninas::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// The result of a double computation, rounded to float once.
constexpr float float_rounding = 6e-8F;

TEST(Srgb, ClosedFormPoints) {
  EXPECT_EQ(srgb_encode(0.0F), 0.0F);
  EXPECT_EQ(srgb_encode(1.0F), 1.0F);
  EXPECT_EQ(srgb_decode(0.0F), 0.0F);
  EXPECT_EQ(srgb_decode(1.0F), 1.0F);
  EXPECT_NEAR(srgb_encode(0.001F), 0.01292F, float_rounding);
  EXPECT_NEAR(srgb_decode(0.01292F), 0.001F, float_rounding);
  // ((0.5 + 0.055) / 1.055)^2.4 and 1.055 * 0.5^(1/2.4) - 0.055, to nine digits.
  EXPECT_NEAR(srgb_decode(0.5F), 0.214041140F, float_rounding);
  EXPECT_NEAR(srgb_encode(0.5F), 0.735356983F, float_rounding);
  EXPECT_NEAR(srgb_encode(0.18F), 0.461356129F, float_rounding);
}

TEST(Srgb, ClippedOutside) {
  for (const float low : {-1e-6F, -1.0F, -infinity, nan}) {
    EXPECT_EQ(srgb_encode(low), 0.0F);
    EXPECT_EQ(srgb_decode(low), 0.0F);
  }
  for (const float high : {1.0001F, 1e30F, infinity}) {
    EXPECT_EQ(srgb_encode(high), 1.0F);
    EXPECT_EQ(srgb_decode(high), 1.0F);
  }
}

TEST(Srgb, MonotonicAndInverse) {
  float encoded_before = -1.0F, decoded_before = -1.0F;
  for (int k = 0; k <= 100000; ++k) {
    const float value = static_cast<float>(k) / 100000.0F;
    const float encoded = srgb_encode(value), decoded = srgb_decode(value);
    EXPECT_GT(encoded, encoded_before) << value;
    EXPECT_GT(decoded, decoded_before) << value;
    encoded_before = encoded;
    decoded_before = decoded;
    // The standard's constants are rounded:
    // the two pieces meet to 4e-8 in linear value only. To that come two roundings.
    EXPECT_NEAR(srgb_decode(encoded), value, 2e-7F);
  }
}

TEST(DisplayCodes, RoundToNearest) {
  // A thousandth of a code beside the middle between two codes, in either direction.
  for (int code = 1; code < 256; ++code) {
    const double middle = (code - 0.5) / 255.0, step = 0.001 / 255.0;
    Image picture(2, 1);
    picture.at(0, 0) = glm::vec3(srgb_decode(static_cast<float>(middle - step)));
    picture.at(1, 0) = glm::vec3(srgb_decode(static_cast<float>(middle + step)));
    const auto codes = display_codes(picture, 0.0);
    EXPECT_EQ(codes.at(2), code - 1);
    EXPECT_EQ(codes.at(3), code);
  }
}

/// A picture of the given greys, each with a share of 1000 pixels; the rest black.
Image picture_of(const std::vector<std::pair<double, int>>& greys) {
  Image picture(1000, 1);
  std::size_t place = 0;
  for (const auto& [grey, count] : greys)
    for (int k = 0; k < count; ++k)
      picture.pixels.at(place++) = glm::vec3(static_cast<float>(grey));
  return picture;
}

/// Walls from a dark corner to the brightest place, over five stops, with most of them in between.
std::vector<std::pair<double, int>> room(int pixels, double brightness) {
  std::vector<std::pair<double, int>> greys;
  for (int k = 0; k < pixels; ++k) {
    const double x = 2.0 * k / (pixels - 1) - 1.0;
    greys.emplace_back(brightness * std::exp2(2.5 * x * x * x), 1);
  }
  return greys;
}

double shown(double grey, const Image& picture) {
  return grey * std::exp2(automatic_exposure(picture));
}

TEST(AutomaticExposure, ExactlyCovariant) {
  auto greys = room(700, 0.3);
  greys.emplace_back(17.0, 40);
  auto picture = picture_of(greys);
  std::mt19937 engine(3);
  for (auto& pixel : picture.pixels)
    pixel *= glm::vec3(1.0F, static_cast<float>(engine() % 1000U) / 1000.0F, 0.5F);
  const double exposure = automatic_exposure(picture);
  // Down to emission of 1e-12 and up to 1e12: 2^-40 ... 2^40.
  for (int k = -60; k <= 60; ++k) {
    Image scaled = picture;
    for (auto& pixel : scaled.pixels)
      pixel *= std::ldexp(1.0F, k);
    EXPECT_EQ(automatic_exposure(scaled), exposure - k);
  }
  // Between powers of two, by one step of 1/16 stop at most.
  for (const float factor : {0.3F, 0.9F, 1.1F, 1.7F}) {
    Image scaled = picture;
    for (auto& pixel : scaled.pixels)
      pixel *= factor;
    EXPECT_NEAR(automatic_exposure(scaled), exposure - std::log2(factor), 1.0 / 16.0 + 1e-9);
  }
}

TEST(AutomaticExposure, OrderOfPixelsDoesNotMatter) {
  auto picture = random_picture(40, 30);
  const double exposure = automatic_exposure(picture);
  std::ranges::reverse(picture.pixels);
  EXPECT_EQ(automatic_exposure(picture), exposure);
}

TEST(AutomaticExposure, NothingToExpose) {
  EXPECT_EQ(automatic_exposure(Image()), 0.0);
  EXPECT_EQ(automatic_exposure(Image(10, 10)), 0.0);
  Image odd(3, 1);
  odd.pixels = {glm::vec3(-1.0F), glm::vec3(infinity), glm::vec3(nan)};
  EXPECT_EQ(automatic_exposure(odd), 0.0);
}

TEST(AutomaticExposure, InfinitiesAreLeftOut) {
  auto picture = picture_of(room(900, 1.0));
  const double exposure = automatic_exposure(picture);
  for (int k = 900; k < 1000; ++k)
    picture.at(k, 0) = glm::vec3(infinity);
  EXPECT_EQ(automatic_exposure(picture), exposure);
}

TEST(AutomaticExposure, UniformPictureIsMiddleGrey) {
  // Half a bin and half a step of the result are 1/16 stop together.
  for (const double grey : {1e-12, 0.1, 1.0, 7.3, 1e12})
    EXPECT_NEAR(std::log2(shown(grey, picture_of({{grey, 1000}})) / 0.22), 0.0, 1.0 / 16.0);
}

TEST(AutomaticExposure, SinglePixel) {
  Image picture(1, 1);
  picture.at(0, 0) = glm::vec3(3.0F);
  EXPECT_NEAR(std::log2(shown(3.0, picture) / 0.22), 0.0, 1.0 / 16.0);
}

TEST(AutomaticExposure, RoomIsWellExposed) {
  // Dark or bright, its middle is between a dim and a light grey,
  // and its brightest place does not clip by much.
  for (const double brightness : {1e-6, 1.0, 1e6}) {
    const auto picture = picture_of(room(1000, brightness));
    EXPECT_GT(shown(brightness, picture), 0.08);
    EXPECT_LT(shown(brightness, picture), 0.25);
    EXPECT_LT(shown(brightness * std::exp2(2.5), picture), 1.5);
  }
}

TEST(AutomaticExposure, SmallLampsClipWithoutDarkeningTheRoom) {
  const double alone = shown(1.0, picture_of(room(970, 1.0)));
  for (const double lamp : {20.0, 1e3, 1e5}) {
    auto greys = room(970, 1.0);
    greys.emplace_back(lamp, 30);
    EXPECT_NEAR(std::log2(shown(1.0, picture_of(greys)) / alone), 0.0, 0.25) << lamp;
  }
}

TEST(AutomaticExposure, WindowsDarkenTheRoomByAboutAStop) {
  const double alone = shown(1.0, picture_of(room(850, 1.0)));
  for (const double window : {20.0, 1e3}) {
    auto greys = room(850, 1.0);
    greys.emplace_back(window, 150);
    const double change = std::log2(shown(1.0, picture_of(greys)) / alone);
    EXPECT_LT(change, 0.0) << window;
    EXPECT_GT(change, -2.5) << window;
  }
}

TEST(AutomaticExposure, PoolOfLightKeepsSomeForm) {
  // A spot of 10 % five stops above the dim rest: both can be seen.
  auto greys = room(900, 1.0);
  greys.emplace_back(32.0, 100);
  const auto picture = picture_of(greys);
  EXPECT_GT(shown(1.0, picture), 0.05);
  EXPECT_LT(shown(32.0, picture), 4.5);
}

TEST(AutomaticExposure, SmallObjectOnBlack) {
  const double alone = automatic_exposure(picture_of(room(1000, 1.0)));
  // 20 of 1000 pixels; sampled coarsely, so the percentiles differ by a quarter stop.
  EXPECT_NEAR(automatic_exposure(picture_of(room(20, 1.0))), alone, 0.25);
  // Not quite black: what fell into the background by way of the filter or a far reflection.
  auto dusty = room(20, 1.0);
  dusty.emplace_back(1e-7, 980);
  EXPECT_NEAR(automatic_exposure(picture_of(dusty)), alone, 0.25);
}

TEST(AutomaticExposure, DarkHalfDoesNotBurnTheOther) {
  auto greys = room(500, 1.0);
  greys.emplace_back(1e-3, 500);
  EXPECT_LT(shown(1.0, picture_of(greys)), 0.9);
}

} // namespace
} // namespace meninas::test
