// Textures over footprints:
// means in the pyramid, and look-ups that average as much as they are told and no more.
#include "scenes/materials/texture_lookup.h"
#include "scenes/materials/texture_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace meninas::test {
namespace {

TexturePixels noise(int width, int height) {
  TexturePixels image{width, height, {}};
  for (int k = 0; k < width * height; ++k)
    image.texels.emplace_back(glm::vec4(float(k * 7919 % 101) / 101.0F));
  image.coarser = coarser_levels(image);
  return image;
}

double mean_of(const TexturePixels& image) {
  double sum = 0.0;
  for (const glm::vec4& texel : image.texels)
    sum += double{texel.r} / double(image.texels.size());
  return sum;
}

const Texture repeating{.name = "t", .encoded = {}};

TEST(TexturePyramid, EveryLevelHasTheMeanOfTheImageAtAnySize) {
  for (const auto& [width, height] :
       {std::pair{64, 64}, {5, 3}, {37, 1}, {1, 9}, {100, 7}, {1, 1}}) {
    const TexturePixels image = noise(width, height);
    int w = width, h = height;
    for (const TexturePixels& level : image.coarser) {
      w = std::max(1, w / 2);
      h = std::max(1, h / 2);
      EXPECT_EQ(level.width, w);
      EXPECT_EQ(level.height, h);
      // Sums of a hundred floats.
      EXPECT_NEAR(mean_of(level), mean_of(image), 1e-5);
    }
    EXPECT_EQ(w * h, 1);
  }
}

TEST(TexturePyramid, APointIsLookedUpInTheImageItself) {
  const TexturePixels image = noise(16, 16);
  TexturePixels alone = image;
  alone.coarser.clear();
  for (const Vec2 uv : {Vec2(0.3, 0.4), Vec2(0.0, 1.7)})
    for (const double size : {0.0, 0.5 / 16.0, 1.0 / 16.0})
      EXPECT_EQ(texture_value(image, repeating, uv, {{size, 0.0}, {0.0, size}}),
                texture_value(alone, repeating, uv));
}

TEST(TexturePyramid, AFootprintAsLargeAsTheImageIsItsMean) {
  const TexturePixels image = noise(32, 16);
  for (const Vec2 uv : {Vec2(0.3, 0.4), Vec2(0.9, 0.05)})
    for (const double times : {1.0, 3.0, 1e6})
      EXPECT_NEAR(texture_value(image, repeating, uv, {{times, 0.0}, {0.0, times}}).r,
                  mean_of(image), 1e-5);
}

TEST(TexturePyramid, ALongFootprintBlursAlongItselfAlone) {
  // Columns of 0 and 1: along them nothing changes, across them all is lost.
  TexturePixels columns{64, 64, {}};
  for (int k = 0; k < 64 * 64; ++k)
    columns.texels.emplace_back(glm::vec4(k % 64 % 8 < 4 ? 1.0F : 0.0F));
  columns.coarser = coarser_levels(columns);
  const Vec2 white(2.0 / 64.0, 0.5), black(6.0 / 64.0, 0.5);
  const Vec2 texel(1.0 / 64.0, 0.0), long_down(0.0, 16.0 / 64.0), long_across(16.0 / 64.0, 0.0);
  EXPECT_NEAR(texture_value(columns, repeating, white, {long_down, texel}).r, 1.0, 1e-6);
  EXPECT_NEAR(texture_value(columns, repeating, black, {texel, long_down}).r, 0.0, 1e-6)
      << "whichever is called the longer";
  for (const Vec2& uv : {white, black})
    EXPECT_NEAR(texture_value(columns, repeating, uv, {long_across, {0.0, 1.0 / 64.0}}).r, 0.5,
                1e-6)
        << "two whole periods";
}

TEST(TexturePyramid, FootprintsWithoutEndAreFinite) {
  const TexturePixels image = noise(8, 8);
  for (const double size : {1e-300, 1e300, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(
        std::isfinite(texture_value(image, repeating, {0.5, 0.5}, {{size, 0.0}, {0.0, size}}).r));
}

} // namespace
} // namespace meninas::test
