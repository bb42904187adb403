// Sizes of images by their headers, and of what only begins like one.
#include "scenes/materials/image_size.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace meninas::test {
namespace {

using Bytes = std::vector<unsigned char>;

void expect_size(const Bytes& bytes, std::uint32_t width, std::uint32_t height) {
  const auto size = image_size(bytes);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, width);
  EXPECT_EQ(size->height, height);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    image_size(std::span(bytes).first(length)); // no byte behind the end is read
  }
}

TEST(ImageSizes, OfHeaders) {
  expect_size({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D',
               'R',  0,   0,   2,   1,    0,    0,    1,    2, 8, 2, 0,  0,   0},
              513, 258);
  expect_size({0xFF, 0xD8, 0xFF, 0xE0, 0,  4, 1, 2, 0xFF, 0xC4, 0, 2,
               0xFF, 0xFF, 0xC2, 0,    17, 8, 1, 2, 3,    4,    3, 0},
              772, 258);
  // A lossless WebP of one pixel, whole.
  expect_size({'R',  'I',  'F',  'F',  0x1a, 0,    0,    0,    'W',  'E', 'B', 'P',
               'V',  'P',  '8',  'L',  0x0d, 0,    0,    0,    0x2f, 0,   0,   0,
               0x10, 0x07, 0x10, 0x11, 0x11, 0x88, 0x88, 0xfe, 0x07, 0},
              1, 1);
  expect_size({'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E',  'B', 'P', 'V', 'P', '8',
               'X', 10,  0,   0,   0, 0, 0, 0, 0,   0xFF, 1,   0,   2,   0,   0},
              512, 3);
}

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(ImageSizes, OfPicturesInFloats) {
  using namespace std::literals;
  // Corners (-2, 1) and (509, 256), both in the picture.
  expect_size(bytes_of("\x76\x2f\x31\x01\2\0\0\0channels\0chlist\0\1\0\0\0\0"
                       "dataWindow\0box2i\0\x10\0\0\0\xfe\xff\xff\xff\1\0\0\0\xfd\1\0\0\0\1\0\0"sv),
              512, 256);
  expect_size(bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 480 +X 640\n"), 640, 480);
  expect_size(bytes_of("#?RGBE\n\n+X 17 -Y 3\n"), 17, 3);
  EXPECT_FALSE(image_size(bytes_of("#?RGBE\n\n-Z 3 +X 17\n")));
}

TEST(ImageSizes, NotOfOthers) {
  EXPECT_FALSE(image_size(Bytes{}));
  EXPECT_FALSE(image_size(Bytes(100, 0x89)));
  EXPECT_FALSE(image_size(Bytes{0xFF, 0xD8, 0xFF, 0xD9, 0, 0, 0, 0, 0, 0, 0, 0}));
}

} // namespace
} // namespace meninas::test
