// PNGs as sloppy and as hostile as they come:
// pixels or one line, and not a word from libpng on stderr.
#include "image/image_file.h"
#include "scenes/errors.h"

#include <gmock/gmock.h>

#include <span>
#include <string>
#include <vector>

namespace meninas::test {
namespace {

using ::testing::HasSubstr;

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift & 0xffU);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& content) {
  std::uint32_t remainder = ~0U;
  for (const char c : type + content) {
    remainder ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 1U) != 0 ? 0xedb88320U ^ remainder >> 1U : remainder >> 1U;
  }
  return big_endian(static_cast<std::uint32_t>(content.size())) + type + content +
         big_endian(~remainder);
}

/// One stored block, RFC 1950 and 1951.
std::string compressed(const std::string& data) {
  std::uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(data.size());
  const auto little = [](std::uint32_t x) {
    return std::string{static_cast<char>(x & 0xffU), static_cast<char>(x >> 8U & 0xffU)};
  };
  return "\x78\x01\x01" + little(size) + little(~size) + data + big_endian(b << 16U | a);
}

struct Png {
  std::uint32_t width = 2, height = 2;
  char depth = 8, colour_type = 0, interlaced = 0;
  std::string before = {}; ///< chunks between the header and the pixels
  std::string data = compressed(std::string("\0\x40\x80\0\xc0\xff", 6));
  std::string after = {};
};

std::string bytes_of(const Png& png) {
  const std::string header = big_endian(png.width) + big_endian(png.height) + png.depth +
                             png.colour_type + '\0' + '\0' + png.interlaced;
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + png.before + chunk("IDAT", png.data) +
         png.after + chunk("IEND", "");
}

/// The line of the error, `pixels` when there is none. Whatever stands on stderr is part of it.
std::string decoded(const Png& png) {
  ::testing::internal::CaptureStderr();
  std::string line = "pixels";
  try {
    const std::string bytes = bytes_of(png);
    decode_image(std::as_bytes(std::span(bytes)), Encoding::linear, "image0");
  } catch (const InputError& error) {
    line = error.what();
  }
  return line + ::testing::internal::GetCapturedStderr();
}

TEST(PngRows, BrokenOnesAreOneLine) {
  const std::string ok = compressed(std::string(6, '\0')), palette("\1\2\3\4\5\6", 6);
  struct Case {
    Png png;
    const char* line;
  };
  const Case cases[] = {
      {{.width = 0}, "Invalid IHDR data"},
      {{.height = 2000000}, "too many"},
      {{.depth = 3}, "Invalid IHDR data"},
      {{.depth = 4, .colour_type = 2}, "Invalid IHDR data"},
      {{.colour_type = 5}, "Invalid IHDR data"},
      {{.interlaced = 2}, "Invalid IHDR data"},
      {{.colour_type = 3}, "Missing PLTE before IDAT"},
      {{.colour_type = 3, .before = chunk("PLTE", "four")}, "PLTE: invalid"},
      {{.colour_type = 3, .data = ok, .after = chunk("PLTE", palette)}, "Missing PLTE before IDAT"},
      {{.data = ""}, "Not enough image data"},
      {{.data = ok.substr(0, 9)}, "Not enough image data"},
      {{.data = compressed(std::string(5, '\0'))}, "Not enough image data"},
      {{.data = "no deflated data"}, "IDAT: incorrect header check"},
      {{.data = compressed(std::string("\0\0\0\5\0\0", 6))}, "bad adaptive filter value"},
      {{.interlaced = 1, .data = ok}, "Not enough image data"},
      {{.before = chunk("IHDR", std::string(13, '\1'))}, "IHDR: out of place"},
      {{.colour_type = 3, .before = chunk("PLTE", palette) + chunk("PLTE", palette), .data = ok},
       "PLTE: duplicate"},
  };
  for (const Case& each : cases) {
    EXPECT_THAT(decoded(each.png), HasSubstr(each.line));
    EXPECT_EQ(decoded(each.png).find("libpng"), std::string::npos) << decoded(each.png);
    EXPECT_EQ(decoded(each.png).find('\n'), std::string::npos);
  }
}

TEST(PngRows, SloppyOnesArePixels) {
  const std::string palette("\1\2\3\4\5\6", 6),
      indices = compressed(std::string("\0\0\1\0\1\0", 6));
  const Png sloppy[] = {
      {},
      {.before = chunk("PLTE", palette) + chunk("tRNS", "too long")},
      {.before = chunk("gAMA", "") + chunk("sBIT", "none") + chunk("iCCP", "no profile")},
      {.data = compressed(std::string(20, '\0'))},
      {.after = chunk("IDAT", "") + chunk("tRNS", std::string(2, '\0'))},
      {.colour_type = 3, .before = chunk("PLTE", palette), .data = indices},
      {.colour_type = 3,
       .before = chunk("PLTE", palette) + chunk("tRNS", "\x80"),
       .data = indices},
      // In the passes of Adam7 two by two pixels are one, one and two.
      {.interlaced = 1, .data = compressed(std::string(7, '\0'))},
  };
  for (const Png& png : sloppy)
    EXPECT_EQ(decoded(png), "pixels") << &png - sloppy;
}

/// A sample of the first pixel of one row of one pixel, its bits at the left end of the row.
Bitmap one_pixel(char depth, char colour_type, const std::string& row, const std::string& before) {
  const std::string bytes = bytes_of({.width = 1,
                                      .height = 1,
                                      .depth = depth,
                                      .colour_type = colour_type,
                                      .before = before,
                                      .data = compressed('\0' + row)});
  return decode_image(std::as_bytes(std::span(bytes)), Encoding::linear, "image0");
}

// Code values over the largest of their depth (PNG specification, 13.12),
// palettes looked up, clear colours without alpha.
TEST(PngRows, EveryKindOfPixelIsItsCodeValueOverTheLargest) {
  const std::string palette("\x33\x66\x99\xff\0\0", 6);
  struct Case {
    char depth, colour_type;
    std::string row, before;
    glm::vec4 pixel;
  };
  const Case cases[] = {
      {1, 0, "\x80", "", {1, 1, 1, 1}},
      {2, 0, "\x80", "", {170.0F / 255.0F, 170.0F / 255.0F, 170.0F / 255.0F, 1}},
      {4, 0, "\x30", "", {51.0F / 255.0F, 51.0F / 255.0F, 51.0F / 255.0F, 1}},
      {8, 0, "\x33", "", {0.2F, 0.2F, 0.2F, 1}},
      {8, 0, "\x33", chunk("tRNS", std::string("\0\x33", 2)), {0.2F, 0.2F, 0.2F, 0}},
      {16, 0, "\x33\x33", "", {0.2F, 0.2F, 0.2F, 1}},
      {8, 4, "\x33\x66", "", {0.2F, 0.2F, 0.2F, 0.4F}},
      {8, 2, "\x33\x66\x99", "", {0.2F, 0.4F, 0.6F, 1}},
      {8, 6, "\x33\x66\x99\xcc", "", {0.2F, 0.4F, 0.6F, 0.8F}},
      {16, 6, "\x33\x33\x66\x66\x99\x99\xcc\xcc", "", {0.2F, 0.4F, 0.6F, 0.8F}},
      {1, 3, std::string("\0", 1), chunk("PLTE", palette), {0.2F, 0.4F, 0.6F, 1}},
      {8, 3, std::string("\0", 1), chunk("PLTE", palette) + chunk("tRNS", "\x66"), {0.2F, 0.4F, 0.6F, 0.4F}},
  };
  for (const Case& each : cases) {
    const Bitmap read = one_pixel(each.depth, each.colour_type, each.row, each.before);
    ASSERT_EQ(read.pixels.size(), 1U);
    for (int c = 0; c < 4; ++c)
      EXPECT_FLOAT_EQ(read.pixels[0][c], each.pixel[c])
          << int{each.depth} << " bits, colour type " << int{each.colour_type} << ", channel " << c;
  }
}

} // namespace
} // namespace meninas::test
