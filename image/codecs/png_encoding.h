// Pictures as PNG files, by libpng alone:
// what writes needs none of the 260 shared objects that OpenImageIO brings.
#pragma once

#include "image/picture_options.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meninas {

/// RGB of 8 bits, marked as sRGB. `codes`: width * height * 3 code values, rows from the top.
/// Throws std::runtime_error where the library cannot go on.
std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint8_t> codes,
                                  Compression compression);

} // namespace meninas
