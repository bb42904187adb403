// Windows of a picture: every pixel is in one part, and parts are whole tiles.
#include "raytrace/pixels/picture_window.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas {
namespace {

void expect_each_pixel_once(int width, int height, int count) {
  SCOPED_TRACE(testing::Message() << width << "x" << height << " in " << count);
  std::vector<int> times(static_cast<std::size_t>(width * height), 0);
  for (int part = 0; part < count; ++part) {
    const PictureWindow window = window_of_part(width, height, part, count);
    ASSERT_GT(window.width, 0);
    ASSERT_GT(window.height, 0);
    EXPECT_EQ(window.x % tile_size, 0);
    EXPECT_EQ(window.y % tile_size, 0);
    EXPECT_TRUE(window.width % tile_size == 0 || window.x + window.width == width);
    EXPECT_TRUE(window.height % tile_size == 0 || window.y + window.height == height);
    for (int y = window.y; y < window.y + window.height; ++y)
      for (int x = window.x; x < window.x + window.width; ++x)
        ++times[static_cast<std::size_t>(y * width + x)];
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](int n) { return n == 1; }));
}

TEST(PictureWindow, PartsCoverEachPixelOnce) {
  for (int count = 1; count <= max_parts(200, 150); ++count)
    expect_each_pixel_once(200, 150, count);
  for (const int count : {1, 2, 3, 7})
    expect_each_pixel_once(7 * tile_size, 1, count);
  expect_each_pixel_once(1, 1, 1);
  expect_each_pixel_once(33, 33, 4);
}

TEST(PictureWindow, PartsAreAlike) {
  // Halving is off by at most half a tile of the longer side at each cut.
  std::vector<int> sizes;
  for (int part = 0; part < 16; ++part) {
    const PictureWindow window = window_of_part(1920, 1088, part, 16);
    sizes.push_back(window.width * window.height);
  }
  EXPECT_LT(std::ranges::max(sizes), 1.35 * std::ranges::min(sizes));
}

TEST(PictureWindow, KnowsThePixelsAround) {
  const PictureWindow window{32, 0, 32, 32};
  const PixelMask around = pixels_around(window, 96, 64, {});
  EXPECT_EQ(std::ranges::count(around, 1), 2 * 32 + 34) << "left, right, and below with corners";
  PixelMask some(96 * 64, 0);
  some[31] = some[32] = some[30] = 1;
  const PixelMask chosen = pixels_around(window, 96, 64, some);
  EXPECT_EQ(std::ranges::count(chosen, 1), 1);
  EXPECT_EQ(chosen[31], 1);
  EXPECT_EQ(std::ranges::count(within(window, 96, PixelMask(96 * 64, 1)), 1), 32 * 32);
  EXPECT_EQ(with_tiles_around(window, 96, 64), (PictureWindow{0, 0, 96, 64}));
}

} // namespace
} // namespace meninas
