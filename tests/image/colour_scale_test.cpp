// Pictures in false colours: the colours of values, lines along steps of the scale, and the scale.
#include "image/colour_map.h"
#include "image/colour_scale.h"
#include "image/display.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

Channel ramp(int width, int height, float top) {
  Channel values(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      values.at(x, y) = top * (static_cast<float>(x) + 0.5F) / static_cast<float>(width);
  return values;
}

Channel all_known(const Channel& like) {
  Channel known(like.width, like.height);
  std::ranges::fill(known.values, 1.0F);
  return known;
}

TEST(ColourScale, LinesAlongTenthsOfTheScale) {
  const Channel values = ramp(100, 4, 50.0F);
  const Image picture = false_colours(values, all_known(values), {.title = "lx", .top = 50.0});
  int lines = 0;
  for (int x = 0; x < 100; ++x) {
    const glm::vec3 pixel = picture.at(x, 1);
    const bool line = pixel == glm::vec3(1.0F) || pixel == glm::vec3(0.0F);
    // Values 0.25, 0.75, ...: the last before 5, 10, ... is the line, white where the scale is dark.
    EXPECT_EQ(line, x % 10 == 9 && x < 99) << x;
    if (line)
      EXPECT_EQ(pixel, glm::vec3(x > 60 ? 0.0F : 1.0F)) << x;
    else
      EXPECT_EQ(pixel, scale_colour((x + 0.5) / 100.0, ErrorScale::magnitude)) << x;
    lines += line ? 1 : 0;
  }
  EXPECT_EQ(lines, 9);
}

TEST(ColourScale, EdgesOfThingsAreNoLines) {
  Channel values(8, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 8; ++x)
      values.at(x, y) = x < 4 ? 14.0F : 16.0F; // over a quarter of a tenth of 50 apart
  const Image picture = false_colours(values, all_known(values), {.title = "", .top = 50.0});
  EXPECT_EQ(picture.at(3, 0), scale_colour(0.28, ErrorScale::magnitude));
  Channel known = all_known(values);
  known.at(0, 0) = 0.0F;
  EXPECT_EQ(false_colours(values, known, {.title = "", .top = 50.0}).at(0, 0), glm::vec3(0.0F));
}

TEST(ColourScale, TheScaleStandsBelowWhereThereIsRoom) {
  const Channel large = ramp(512, 400, 50.0F), small = ramp(64, 48, 50.0F);
  const ColourScale scale{.title = "illuminance lx", .top = 50.0};
  const Image with = false_colours(large, all_known(large), scale);
  const int height = scale_height(512, scale, 1);
  const auto grey = glm::vec3(srgb_decode(0.2F));
  EXPECT_EQ(with.at(0, 399), grey);
  EXPECT_EQ(with.at(0, 400 - height), grey);
  EXPECT_NE(with.at(0, 399 - height), grey);
  const Image without = false_colours(small, all_known(small), scale);
  EXPECT_NE(without.at(0, 47), grey);
}

} // namespace
} // namespace meninas::test
