// The header and the compressed rows of a PNG, looked at before libpng is:
// what it finds wrong with them it writes on stderr.
//
// Rows are decompressed for it once more than for the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace meninas::decoder {

/// PNG specification, 11.2.2.
struct PngHeader {
  std::uint32_t width = 0, height = 0;
  std::uint32_t depth = 8; ///< bits of a channel, or of an index into the palette
  std::uint32_t colour_type = 0;
  bool interlaced = false;
};

inline constexpr std::uint32_t grey_png = 0, rgb_png = 2, palette_png = 3;

/// What a file begins with, and what is around the data of every chunk (5.2 and 5.3).
inline constexpr std::size_t png_signature = 8, png_length_and_type = 8, png_checksum = 4;

/// The checksum of ISO 3309 (annex D).
std::uint32_t checksum_of(std::string_view bytes);

std::uint32_t big_endian(std::string_view four);

/// The thirteen bytes of an IHDR. Throws std::runtime_error when no PNG has such.
PngHeader png_header(std::string_view bytes);

/// Throws std::runtime_error unless the chunks IDAT, which are whole,
/// hold every row, with a filter that exists. Takes no memory for the rows.
void check_png_rows(std::string_view png);

} // namespace meninas::decoder
