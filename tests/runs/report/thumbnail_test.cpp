// Small pictures are means of large ones.
#include "runs/report/thumbnail.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = glm::vec3(static_cast<float>(x), static_cast<float>(y), 1.0F);
    }
  }
  return image;
}

glm::dvec3 mean(const Image& image) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& pixel : image.pixels) {
    sum += glm::dvec3(pixel);
  }
  return sum / double(image.pixels.size());
}

TEST(Thumbnail, SmallPicturesStay) {
  const Image image = ramp(8, 5);
  EXPECT_EQ(thumbnail(image, 8).pixels, image.pixels);
}

TEST(Thumbnail, HasTheShapeAndTheMeanOfThePicture) {
  const Image image = ramp(100, 37); // neither side is a multiple of the small one
  const Image small = thumbnail(image, 30);
  EXPECT_EQ(small.width, 30);
  EXPECT_EQ(small.height, 11);
  // Every pixel of the picture counts the same: means agree to the rounding of float sums.
  EXPECT_NEAR(mean(small).x, mean(image).x, 1e-4);
  EXPECT_NEAR(mean(small).y, mean(image).y, 1e-4);
  EXPECT_NEAR(mean(small).z, 1.0, 1e-6);
}

TEST(Thumbnail, HalvesAreMeansOfFour) {
  const Image small = thumbnail(ramp(4, 2), 2);
  ASSERT_EQ(small.pixels.size(), 2);
  EXPECT_EQ(small.at(0, 0), glm::vec3(0.5F, 0.5F, 1.0F));
  EXPECT_EQ(small.at(1, 0), glm::vec3(2.5F, 0.5F, 1.0F));
}

TEST(Thumbnail, AThinPictureKeepsAPixel) { EXPECT_EQ(thumbnail(ramp(1000, 1), 10).height, 1); }

} // namespace
} // namespace meninas
