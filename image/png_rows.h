// The header and the compressed rows of a PNG, looked at before libpng is: what it finds wrong with them it writes on stderr.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace meninas::image_io {

/// PNG specification, 11.2.2.
struct PngHeader {
  std::uint32_t width = 0, height = 0;
  std::uint32_t depth = 8; ///< bits of a channel, or of an index into the palette
  std::uint32_t colour_type = 0;
  bool interlaced = false;
};

inline constexpr std::uint32_t grey_png = 0, rgb_png = 2, palette_png = 3;

std::uint32_t big_endian(std::string_view four);

/// The thirteen bytes of an IHDR. Throws std::runtime_error when no PNG has such.
PngHeader png_header(std::string_view bytes);

/// Throws std::runtime_error unless the chunks IDAT, which are whole, hold every row, with a filter that exists. Takes no memory for the rows.
void check_png_rows(std::string_view png);

} // namespace meninas::image_io
