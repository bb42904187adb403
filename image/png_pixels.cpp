#include "image/png_pixels.h"

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

static std::uint32_t big_endian(std::string_view four) {
  std::uint32_t value = 0;
  for (const char c : four.substr(0, 4))
    value = value << 8U | static_cast<std::uint8_t>(c);
  return value;
}

std::vector<std::uint8_t> png_pixel_chunks(std::string_view png) {
  constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
  constexpr std::array<std::string_view, 5> kept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::vector<std::uint8_t> pixels(png.begin(), png.begin() + signature);
  std::string_view rest = png.substr(signature);
  bool any_data = false;
  for (std::string_view type; type != "IEND";) {
    if (rest.size() < length_and_type + checksum)
      throw std::runtime_error("the PNG ends too early");
    const std::size_t length = big_endian(rest);
    if (rest.size() - length_and_type - checksum < length)
      throw std::runtime_error("the PNG ends too early");
    type = rest.substr(4, 4);
    if (pixels.size() == signature && (type != "IHDR" || length != 13))
      throw std::runtime_error("the PNG has no header");

    const auto chunk = rest.substr(0, length_and_type + length + checksum);
    rest.remove_prefix(chunk.size());
    if (std::ranges::find(kept, type) == kept.end())
      continue;
    if (crc32(chunk.substr(4, 4 + length)) != big_endian(chunk.substr(length_and_type + length)))
      throw std::runtime_error("the PNG is damaged: wrong checksum of its chunk " +
                               std::string(type));
    any_data = any_data || type == "IDAT";
    pixels.insert(pixels.end(), chunk.begin(), chunk.end());
  }
  if (!any_data)
    throw std::runtime_error("the PNG holds no pixels");
  return pixels;
}

} // namespace meninas::image_io
