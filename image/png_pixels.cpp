#include "image/png_pixels.h"

#include "image/png_rows.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace meninas::image_io {

/// The checksum of ISO 3309, a byte at a time (PNG specification, annex D).
static std::uint32_t crc32(std::string_view bytes) {
  static constexpr auto table = [] {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t remainder = byte;
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder & 1U) != 0 ? 0xedb88320U ^ (remainder >> 1U) : remainder >> 1U;
      remainders[byte] = remainder;
    }
    return remainders;
  }();
  std::uint32_t remainder = 0xffffffffU;
  for (const char c : bytes)
    remainder = table[(remainder ^ static_cast<std::uint8_t>(c)) & 0xffU] ^ (remainder >> 8U);
  return ~remainder;
}

/// What of the chunks beside the pixels means something for them; of the rest libpng would speak on stderr.
static bool belongs(const PngHeader& header, std::string_view type, std::size_t length,
                    std::size_t colours) {
  constexpr std::size_t most_colours = 256;
  if (type == "PLTE")
    return header.colour_type == palette_png && colours == 0 && length > 0 && length % 3 == 0 &&
           length / 3 <= std::min(most_colours, std::size_t{1} << header.depth);
  if (type == "tRNS") // of a palette an alpha for each colour, else one colour that is clear
    return header.colour_type == palette_png ? length > 0 && length <= colours
           : header.colour_type == grey_png  ? length == 2
                                             : header.colour_type == rgb_png && length == 6;
  return true;
}

std::vector<std::uint8_t> png_pixel_chunks(std::string_view png) {
  constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
  constexpr std::array<std::string_view, 5> kept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::vector<std::uint8_t> pixels(png.begin(), png.begin() + signature);
  std::string_view rest = png.substr(signature);
  PngHeader header;
  std::size_t colours = 0;
  bool any_data = false, any_alpha = false;
  for (std::string_view type; type != "IEND";) {
    if (rest.size() < length_and_type + checksum)
      throw std::runtime_error("the PNG ends too early");
    const std::size_t length = big_endian(rest);
    if (rest.size() - length_and_type - checksum < length)
      throw std::runtime_error("the PNG ends too early");
    type = rest.substr(4, 4);
    if (pixels.size() == signature && (type != "IHDR" || length != 13))
      throw std::runtime_error("the PNG has no header");
    const bool repeated = (type == "IHDR" && pixels.size() > signature) ||
                          (type == "tRNS" && any_alpha) ||
                          (type != "IEND" && type != "IDAT" && any_data);

    const auto chunk = rest.substr(0, length_and_type + length + checksum);
    rest.remove_prefix(chunk.size());
    if (std::ranges::find(kept, type) == kept.end() || repeated ||
        !belongs(header, type, length, colours))
      continue;
    if (crc32(chunk.substr(4, 4 + length)) != big_endian(chunk.substr(length_and_type + length)))
      throw std::runtime_error("the PNG is damaged: wrong checksum of its chunk " +
                               std::string(type));
    if (type == "IHDR")
      header = png_header(chunk.substr(length_and_type));
    if (type == "PLTE")
      colours = length / 3;
    any_alpha = any_alpha || type == "tRNS";
    any_data = any_data || type == "IDAT";
    pixels.insert(pixels.end(), chunk.begin(), chunk.end());
  }
  if (!any_data)
    throw std::runtime_error("the PNG holds no pixels");
  if (header.colour_type == palette_png && colours == 0)
    throw std::runtime_error("the PNG has no palette");
  return pixels;
}

} // namespace meninas::image_io
