// PNG files hold the displayed picture;
// textures in PNG and JPEG come out linear, with straight alpha.
#include "image/display.h"
#include "image/image_file.h"
#include "tests/image/picture_files.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace meninas::test {
namespace {

class Png : public PictureFiles {};

template <std::size_t Size>
std::span<const std::byte> as_encoded(const unsigned char (&bytes)[Size]) {
  return std::as_bytes(std::span(bytes));
}

// 2 x 1 pixels of 8-bit RGBA: (255, 0, 128, 128) and (10, 20, 30, 0). One stored deflate block
// without filter, and a gAMA chunk of 1.0, which must not count.
constexpr unsigned char rgba_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0xf4, 0x22, 0x7f,
    0x8a, 0x00, 0x00, 0x00, 0x04, 0x67, 0x41, 0x4d, 0x41, 0x00, 0x01, 0x86, 0xa0, 0x31, 0xe8, 0x96,
    0x5f, 0x00, 0x00, 0x00, 0x14, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x09, 0x00, 0xf6, 0xff,
    0x00, 0xff, 0x00, 0x80, 0x80, 0x0a, 0x14, 0x1e, 0x00, 0x0e, 0x21, 0x02, 0x3c, 0xb4, 0x42, 0x1e,
    0x60, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
};
// 8 x 8 pixels of mid grey, one channel.
constexpr unsigned char grey_jpeg[] = {
    0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10, 0x4a, 0x46, 0x49, 0x46, 0x00, 0x01, 0x01, 0x00, 0x00, 0x01,
    0x00, 0x01, 0x00, 0x00, 0xff, 0xdb, 0x00, 0x43, 0x00, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
    0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
    0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
    0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
    0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01, 0xff, 0xc0, 0x00, 0x0b, 0x08, 0x00, 0x08,
    0x00, 0x08, 0x01, 0x01, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x1f, 0x00, 0x00, 0x01, 0x05, 0x01, 0x01,
    0x01, 0x01, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x02, 0x03, 0x04,
    0x05, 0x06, 0x07, 0x08, 0x09, 0x0a, 0x0b, 0xff, 0xc4, 0x00, 0xb5, 0x10, 0x00, 0x02, 0x01, 0x03,
    0x03, 0x02, 0x04, 0x03, 0x05, 0x05, 0x04, 0x04, 0x00, 0x00, 0x01, 0x7d, 0x01, 0x02, 0x03, 0x00,
    0x04, 0x11, 0x05, 0x12, 0x21, 0x31, 0x41, 0x06, 0x13, 0x51, 0x61, 0x07, 0x22, 0x71, 0x14, 0x32,
    0x81, 0x91, 0xa1, 0x08, 0x23, 0x42, 0xb1, 0xc1, 0x15, 0x52, 0xd1, 0xf0, 0x24, 0x33, 0x62, 0x72,
    0x82, 0x09, 0x0a, 0x16, 0x17, 0x18, 0x19, 0x1a, 0x25, 0x26, 0x27, 0x28, 0x29, 0x2a, 0x34, 0x35,
    0x36, 0x37, 0x38, 0x39, 0x3a, 0x43, 0x44, 0x45, 0x46, 0x47, 0x48, 0x49, 0x4a, 0x53, 0x54, 0x55,
    0x56, 0x57, 0x58, 0x59, 0x5a, 0x63, 0x64, 0x65, 0x66, 0x67, 0x68, 0x69, 0x6a, 0x73, 0x74, 0x75,
    0x76, 0x77, 0x78, 0x79, 0x7a, 0x83, 0x84, 0x85, 0x86, 0x87, 0x88, 0x89, 0x8a, 0x92, 0x93, 0x94,
    0x95, 0x96, 0x97, 0x98, 0x99, 0x9a, 0xa2, 0xa3, 0xa4, 0xa5, 0xa6, 0xa7, 0xa8, 0xa9, 0xaa, 0xb2,
    0xb3, 0xb4, 0xb5, 0xb6, 0xb7, 0xb8, 0xb9, 0xba, 0xc2, 0xc3, 0xc4, 0xc5, 0xc6, 0xc7, 0xc8, 0xc9,
    0xca, 0xd2, 0xd3, 0xd4, 0xd5, 0xd6, 0xd7, 0xd8, 0xd9, 0xda, 0xe1, 0xe2, 0xe3, 0xe4, 0xe5, 0xe6,
    0xe7, 0xe8, 0xe9, 0xea, 0xf1, 0xf2, 0xf3, 0xf4, 0xf5, 0xf6, 0xf7, 0xf8, 0xf9, 0xfa, 0xff, 0xda,
    0x00, 0x08, 0x01, 0x01, 0x00, 0x00, 0x3f, 0x00, 0x2b, 0xff, 0xd9,
};

TEST_F(Png, EveryCodeValueComesBack) {
  // 256 greys at the linear values of their codes, doubled and shown one stop darker.
  Image picture(256, 1);
  for (int code = 0; code < 256; ++code)
    picture.at(code, 0) = glm::vec3(2.0F * srgb_decode(static_cast<float>(code) / 255.0F));
  write_png(folder / "a.png", picture, -1.0);
  const auto read = read_image(folder / "a.png").picture;
  ASSERT_EQ(read.width, 256);
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(read.at(code, 0), glm::vec3(srgb_decode(static_cast<float>(code) / 255.0F))) << code;
}

TEST_F(Png, SixteenBitsTellTwoHundredTimesAsManyValues) {
  Image picture(1000, 3);
  for (int k = 0; k < 1000; ++k)
    for (int y = 0; y < 3; ++y)
      picture.at(k, y) = {1e-3F * float(k), 0.5F, 0.25F * float(y)};
  write_png(folder / "a.png", picture,
            {.exposure = -1.0, .transform = ViewTransform::neutral, .bits = 16});
  const ImageFile file = read_image(folder / "a.png");
  for (int k = 0; k < 1000; ++k)
    for (int y = 0; y < 3; ++y) {
      const glm::dvec3 shown =
          displayed(ViewTransform::neutral, 0.5 * glm::dvec3(picture.at(k, y)));
      for (int c = 0; c < 3; ++c)
        // Half a code value, in linear light at most 2.275 / 2 of it, and a float's rounding.
        EXPECT_NEAR(file.picture.at(k, y)[c], shown[c], 1.2 / 65535.0) << k << ' ' << y << ' ' << c;
    }
  const auto read = bytes_of(folder / "a.png");
  const std::string bytes(reinterpret_cast<const char*>(read.data()), read.size());
  EXPECT_EQ(bytes[24], 16);
  EXPECT_NE(bytes.find("View transform"), std::string::npos);
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
}

TEST_F(Png, ShowsEdgesInPlaceOfTheirMeansIfTheyAreOfThisDisplay) {
  Image picture(2, 1);
  picture.pixels = {glm::vec3(0.25F), glm::vec3(50.0F)};
  const ShownPixels edges{.exposure = 1.0,
                          .transform = ViewTransform::srgb,
                          .pixels = {{1, glm::vec3(0.5F, 0.25F, 1.0F)}}};
  const auto shown = [&](double exposure, ViewTransform transform, int bits) {
    write_png(folder / "a.png", picture,
              {.exposure = exposure, .transform = transform, .edges = &edges, .bits = bits});
    return read_image(folder / "a.png").picture;
  };
  for (const int bits : {8, 16}) {
    const Image own = shown(1.0, ViewTransform::srgb, bits);
    // Half a code value of 8 bits is at most 2.275 / 510 in linear light.
    EXPECT_NEAR(own.at(0, 0).g, 0.5F, 0.005F);
    EXPECT_NEAR(own.at(1, 0).r, 0.5F, 0.005F);
    EXPECT_NEAR(own.at(1, 0).g, 0.25F, 0.005F);
    EXPECT_EQ(own.at(1, 0).b, 1.0F);
    EXPECT_EQ(shown(0.5, ViewTransform::srgb, bits).at(1, 0), glm::vec3(1.0F));
    EXPECT_GT(shown(1.0, ViewTransform::neutral, bits).at(1, 0).g, 0.9F);
  }
}

TEST_F(Png, PixelsKeepTheirPlaceAndChannel) {
  Image picture(3, 2);
  picture.at(2, 0) = {1.0F, 0.0F, 0.0F};
  picture.at(0, 1) = {0.0F, 1.0F, 0.0F};
  picture.at(1, 1) = {0.0F, 0.0F, 1.0F};
  write_png(folder / "a.png", picture, 0.0);
  EXPECT_EQ(read_image(folder / "a.png").picture.pixels, picture.pixels);
}

TEST_F(Png, ClipsAtWhiteAndBlack) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Image picture(2, 1);
  picture.pixels = {{1.0001F, 1e30F, infinity}, {-0.1F, -infinity, 0.0F}};
  for (const double exposure : {0.0, 100.0, 5000.0}) {
    write_png(folder / "a.png", picture, exposure);
    const auto read = read_image(folder / "a.png").picture;
    EXPECT_EQ(read.at(0, 0), glm::vec3(1.0F)) << exposure;
    EXPECT_EQ(read.at(1, 0), glm::vec3(0.0F)) << exposure;
  }
  write_png(folder / "a.png", picture, -5000.0);
  EXPECT_EQ(read_image(folder / "a.png").picture.at(0, 0), glm::vec3(0.0F));
}

TEST_F(Png, NeverShowsNan) {
  Image picture(1, 1);
  picture.at(0, 0).g = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_png(folder / "a.png", picture, 0.0), std::logic_error);
  EXPECT_THROW(write_png(folder / "a.png", Image(1, 1), std::numeric_limits<double>::infinity()),
               std::logic_error);
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Png, SamePictureIsSameFile) {
  const auto picture = random_picture(50, 40);
  write_png(folder / "a.png", picture, 0.5);
  write_png(folder / "b.png", picture, 0.5);
  EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
}

TEST_F(Png, OddSizes) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 5000), std::pair(5000, 1)}) {
    write_png(folder / "a b \xc3\xa9.png", random_picture(width, height), 0.0);
    const auto read = read_image(folder / "a b \xc3\xa9.png").picture;
    EXPECT_EQ(std::pair(read.width, read.height), std::pair(width, height));
  }
}

TEST(DecodeImage, KeepsColourWhereTransparent) {
  const auto linear = decode_image(as_encoded(rgba_png), Encoding::linear, "texture");
  ASSERT_EQ(linear.pixels.size(), 2U);
  // Code values may come by a product with 1/255 instead of a quotient: a rounding apart.
  const glm::vec4 first(255.0F, 0.0F, 128.0F, 128.0F), second(10.0F, 20.0F, 30.0F, 0.0F);
  for (int c = 0; c < 4; ++c) {
    EXPECT_FLOAT_EQ(linear.pixels[0][c], first[c] / 255.0F);
    EXPECT_FLOAT_EQ(linear.pixels[1][c], second[c] / 255.0F);
  }
}

TEST(DecodeImage, DecodesColourButNotAlpha) {
  const auto srgb = decode_image(as_encoded(rgba_png), Encoding::srgb, "texture");
  ASSERT_EQ(srgb.pixels.size(), 2U);
  EXPECT_EQ(glm::vec3(srgb.pixels[0]), glm::vec3(1.0F, 0.0F, srgb_decode(128.0F / 255.0F)));
  EXPECT_FLOAT_EQ(srgb.pixels[0].a, 128.0F / 255.0F);
  EXPECT_EQ(srgb.pixels[1].a, 0.0F);
}

TEST(DecodeImage, GreyIsAllThreeChannels) {
  const auto grey = decode_image(as_encoded(grey_jpeg), Encoding::linear, "texture");
  EXPECT_EQ(std::pair(grey.width, grey.height), std::pair(8, 8));
  // A flat block has only its mean, quantised by the table's first entry, which is 1 here:
  // off by one code at most.
  for (const auto& pixel : grey.pixels) {
    EXPECT_NEAR(pixel.r, 128.0F / 255.0F, 1.0F / 255.0F + 1e-6F);
    EXPECT_EQ(pixel, glm::vec4(pixel.r, pixel.r, pixel.r, 1.0F));
  }
}

TEST_F(Png, AlphaIsNamedAsIgnored) {
  write_bytes(folder / "a.png", {as_encoded(rgba_png).begin(), as_encoded(rgba_png).end()});
  EXPECT_THAT(read_image(folder / "a.png").ignored_channels, ::testing::ElementsAre("A"));
}

TEST_F(Png, ContentDecidesNotTheName) {
  write_png(folder / "a.png", random_picture(5, 4), 0.0);
  std::filesystem::rename(folder / "a.png", folder / "a.exr");
  EXPECT_EQ(read_image(folder / "a.exr").picture.width, 5);
}

} // namespace
} // namespace meninas::test
