#include "scenes/materials/image_size.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

namespace meninas {
namespace {

using Bytes = std::span<const unsigned char>;

bool holds(Bytes bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c, unsigned char b) { return static_cast<unsigned char>(c) == b; });
}

std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < count; ++k)
    value = value << 8 | bytes[at + k];
  return value;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t k = count; k-- > 0;)
    value = value << 8 | bytes[at + k];
  return value;
}

/// The first chunk of a PNG is its header.
std::optional<ImageSize> png_size(Bytes bytes) {
  if (bytes.size() < 24 || !holds(bytes, 12, "IHDR"))
    return std::nullopt;
  return ImageSize{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

/// The segments of a JPEG up to its frame header,
/// SOF0 to SOF15 but for the tables DHT, JPG and DAC among them.
std::optional<ImageSize> jpeg_size(Bytes bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == 0xFF;) {
    const auto marker = bytes[at + 1];
    if (marker == 0xFF) {
      ++at; // a fill byte
      continue;
    }
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame)
      return ImageSize{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    at += 2 + std::max<std::uint32_t>(big_endian(bytes, at + 2, 2), 2);
  }
  return std::nullopt;
}

/// Lossy, lossless or extended, in the container's first chunk.
std::optional<ImageSize> webp_size(Bytes bytes) {
  if (bytes.size() < 30)
    return std::nullopt;
  if (holds(bytes, 12, "VP8 "))
    return ImageSize{little_endian(bytes, 26, 2) & 0x3FFF, little_endian(bytes, 28, 2) & 0x3FFF};
  if (holds(bytes, 12, "VP8L")) {
    const auto bits = little_endian(bytes, 21, 4);
    return ImageSize{(bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1};
  }
  if (holds(bytes, 12, "VP8X"))
    return ImageSize{little_endian(bytes, 24, 3) + 1, little_endian(bytes, 27, 3) + 1};
  return std::nullopt;
}

/// The attribute `dataWindow` of an EXR's first header: two corners, both in it.
std::optional<ImageSize> exr_size(Bytes bytes) {
  using namespace std::literals;
  constexpr auto name = "dataWindow\0box2i\0\x10\0\0\0"sv;
  constexpr std::size_t farthest = 1 << 16; // headers are shorter
  const auto head = bytes.first(std::min(bytes.size(), farthest));
  const auto found =
      std::ranges::search(head, name, {}, {}, [](char c) { return static_cast<unsigned char>(c); });
  const auto at = static_cast<std::size_t>(found.end() - head.begin());
  if (found.empty() || at + 16 > bytes.size())
    return std::nullopt;
  const auto extent = [&](std::size_t low, std::size_t high) {
    return little_endian(bytes, at + high, 4) - little_endian(bytes, at + low, 4) + 1;
  };
  return ImageSize{extent(0, 8), extent(4, 12)};
}

/// The line after the empty one that ends an HDR's header, such as `-Y 480 +X 640`.
std::optional<ImageSize> hdr_size(Bytes bytes) {
  constexpr std::size_t farthest = 1 << 16;
  const std::string head(
      bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), farthest)));
  const auto end = head.find("\n\n");
  char axes[2][2] = {};
  unsigned sizes[2] = {};
  if (end == std::string::npos ||
      std::sscanf(head.c_str() + end + 2, "%*1[+-]%1[XY] %9u %*1[+-]%1[XY] %9u", axes[0], &sizes[0],
                  axes[1], &sizes[1]) != 4)
    return std::nullopt;
  const bool by_columns = axes[0][0] == 'X';
  return ImageSize{sizes[by_columns ? 0 : 1], sizes[by_columns ? 1 : 0]};
}

} // namespace

std::optional<ImageSize> image_size(Bytes encoded) {
  using namespace std::literals;
  if (holds(encoded, 0, "\x89PNG\r\n\x1a\n"sv))
    return png_size(encoded);
  if (holds(encoded, 0, "\xff\xd8\xff"sv))
    return jpeg_size(encoded);
  if (holds(encoded, 0, "RIFF"sv) && holds(encoded, 8, "WEBP"sv))
    return webp_size(encoded);
  if (holds(encoded, 0, "\x76\x2f\x31\x01"sv))
    return exr_size(encoded);
  if (holds(encoded, 0, "#?RADIANCE"sv) || holds(encoded, 0, "#?RGBE"sv))
    return hdr_size(encoded);
  return std::nullopt;
}

} // namespace meninas
