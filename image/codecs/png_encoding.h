// Pictures as PNG files, by libpng alone:
// what writes needs none of the 260 shared objects that OpenImageIO brings.
#pragma once

#include "image/picture_options.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace meninas {

/// A line of text in the file, of printable ASCII; the key has at most 79 letters. None without.
struct PngText {
  std::string_view key, text;
};

/// RGB of 8 or 16 bits, marked as sRGB. `codes`: width * height * 3 code values, rows from the top.
/// Throws std::runtime_error where the library cannot go on.
std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint8_t> codes,
                                  Compression compression, const PngText& text = {});
std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint16_t> codes,
                                  Compression compression, const PngText& text = {});

} // namespace meninas
