// Heat maps: colours, scale and letters.
#include "image/colour_map.h"
#include "image/display.h"
#include "image/metrics/heat_map.h"
#include "image/lettering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

double lightness(const glm::vec3& encoded) {
  const double y = 0.2126 * srgb_decode(encoded.r) + 0.7152 * srgb_decode(encoded.g) +
                   0.0722 * srgb_decode(encoded.b);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(HeatMap, LightnessGrowsEvenly) {
  // From black to nearly white; no step of a twentieth is twice or half as large as the mean one.
  const double whole = lightness(magma(1.0)) - lightness(magma(0.0));
  EXPECT_LT(lightness(magma(0.0)), 1.0);
  EXPECT_GT(whole, 95.0);
  for (int k = 1; k < 20; ++k) {
    const double step = lightness(magma((k + 1) / 20.0)) - lightness(magma(k / 20.0));
    EXPECT_GT(step, 0.5 * whole / 20.0) << k;
    EXPECT_LT(step, 2.0 * whole / 20.0) << k;
  }
  EXPECT_EQ(magma(-1.0), magma(0.0));
  EXPECT_EQ(magma(7.0), magma(1.0));
}

TEST(HeatMap, ScalesEndInRoundNumbers) {
  const auto top_of = [](float value) {
    Channel channel(10, 10);
    std::ranges::fill(channel.values, value);
    return readable_top(channel);
  };
  EXPECT_DOUBLE_EQ(top_of(0.0F), 1.0);
  EXPECT_NEAR(top_of(0.003F), 0.005, 1e-12);
  EXPECT_NEAR(top_of(0.7F), 1.0, 1e-12);
  EXPECT_NEAR(top_of(1.5F), 2.0, 1e-12);
  EXPECT_NEAR(top_of(7e6F), 1e7, 1.0);
  EXPECT_NEAR(top_of(1e-30F), 1e-30, 1e-31 * 11); // at most the next step
}

TEST(HeatMap, AFewFirefliesDoNotDarkenTheRest) {
  Channel channel(100, 100);
  std::ranges::fill(channel.values, 0.04F);
  channel.at(3, 4) = 1e4F;
  EXPECT_NEAR(readable_top(channel), 0.05, 1e-12);
}

TEST(HeatMap, EveryPixelIsASquareOfItsColour) {
  Channel errors(4, 2);
  for (int k = 0; k < 8; ++k)
    errors.values[static_cast<std::size_t>(k)] = static_cast<float>(k);
  const Image map = heat_map(errors, {.title = "rmse 1", .top = 7.0});
  EXPECT_EQ(map.width, 512);
  EXPECT_GT(map.height, 256); // the map is 256 high, the legend is below it
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      for (const int offset : {0, 127}) {
        const glm::vec3 expected = magma(errors.at(x, y) / 7.0);
        EXPECT_EQ(map.at(128 * x + offset, 128 * y + offset).g, srgb_decode(expected.g));
      }
}

TEST(HeatMap, TheLegendSaysTheTitleAndTheScale) {
  Channel errors(64, 64);
  const auto ink = [&](const std::string& title, double top) {
    const Image map = heat_map(errors, {.title = title, .top = top});
    return std::ranges::count(map.pixels, glm::vec3(1.0F));
  };
  // A letter I has 11 dots of 2 x 2 pixels at this width, an 8 one has 17.
  EXPECT_EQ(ink("I", 1.0) - ink("", 1.0), 11 * 4);
  EXPECT_EQ(ink("I8", 1.0) - ink("", 1.0), (11 + 17) * 4);
  EXPECT_NE(ink("", 1.0), ink("", 5.0));
}

TEST(HeatMap, LettersAreCutAtTheBorder) {
  Image picture(8, 8);
  draw_text(picture, -3, -2, "MM", 3, glm::vec3(1.0F));
  draw_text(picture, 6, 6, "8", 1, glm::vec3(0.5F));
  EXPECT_GT(std::ranges::count(picture.pixels, glm::vec3(1.0F)), 0);
  EXPECT_EQ(text_width("", 2), 0);
  EXPECT_EQ(text_width("ab", 2), 22);
}

TEST(HeatMap, TitlesNameTheMetricAndTheWorstPixel) {
  const Image reference(20, 10);
  Image picture = reference;
  picture.at(7, 3) = glm::vec3(0.5F);
  const auto difference = compare_pictures(picture, reference);
  const Channel errors = error_map(difference, Metric::max_abs, picture, reference);
  const auto settings = heat_map_settings(difference, Metric::max_abs, errors);
  EXPECT_EQ(settings.title, "max_abs 0.5, max 0.5 at 7,3");
  EXPECT_NEAR(settings.top, 0.5, 1e-12);
  EXPECT_EQ(heat_map_settings(difference, Metric::flip, difference.flip_map).top, 1.0);
}

} // namespace
} // namespace meninas::test
