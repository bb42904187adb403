#include "image/metrics/relative_error.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

Image filled(float value) {
  Image image(4, 3);
  for (auto& pixel : image.pixels)
    pixel = glm::vec3(value);
  return image;
}

TEST(RelativeError, IsTheRootMeanSquareOverTheMean) {
  Image picture = filled(2.0F);
  EXPECT_DOUBLE_EQ(relative_error(picture, filled(2.0F), {}), 0.0);
  EXPECT_DOUBLE_EQ(relative_error(picture, filled(4.0F), {}), 0.5);
  picture.at(1, 1).g = 5.0F; // one of 36 values off by 3: sqrt(9 / 36) / 2
  EXPECT_DOUBLE_EQ(relative_error(picture, filled(2.0F), {}), 0.25);
}

TEST(RelativeError, LeavesMarkedPixelsOut) {
  Image picture = filled(1.0F), reference = filled(1.0F);
  picture.at(2, 0) = glm::vec3(9.0F);
  reference.at(3, 0) = glm::vec3(1e6F);
  std::vector<std::uint8_t> marked(12, 0);
  marked[2] = marked[3] = 1;
  EXPECT_EQ(relative_error(picture, reference, marked), 0.0);
}

TEST(RelativeError, DoesNotCountTheNoiseOfTheReference) {
  const Image picture = filled(1.0F), reference = filled(2.0F), variance = filled(0.75F);
  EXPECT_DOUBLE_EQ(relative_error(picture, reference, {}, &variance), 0.25);
  const Image larger = filled(2.0F);
  EXPECT_EQ(relative_error(picture, reference, {}, &larger), 0.0);
}

} // namespace
} // namespace meninas::test
