#include "image/codecs/png_encoding.h"

#define ZLIB_CONST // what is read stays as it is
#include <png.h>
#include <zlib.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace meninas {

/// A chunk tEXt (PNG specification, 11.3.4.3), which the library's simple interface cannot write:
/// length, type, key, zero, text, checksum of all but the length.
static std::vector<std::byte> text_chunk(const PngText& text) {
  std::string content = "tEXt";
  content.append(text.key).push_back('\0');
  content.append(text.text);
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()));
  std::vector<std::byte> chunk;
  const auto add_big_endian = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      chunk.push_back(static_cast<std::byte>(value >> shift));
  };
  add_big_endian(static_cast<std::uint32_t>(content.size() - 4));
  for (const char c : content)
    chunk.push_back(static_cast<std::byte>(c));
  add_big_endian(checksum);
  return chunk;
}

std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint8_t> codes,
                                  Compression compression, const PngText& text) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  image.flags = compression == Compression::quick ? PNG_IMAGE_FLAG_FAST : 0;

  // Room for the worst case, where nothing can be compressed; what stays untouched costs nothing.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  const auto bytes = std::make_unique_for_overwrite<std::byte[]>(size);
  constexpr int as_it_is = 0, packed_rows = 0;
  if (png_image_write_to_memory(&image, bytes.get(), &size, as_it_is, codes.data(), packed_rows,
                                nullptr) == 0)
    throw std::runtime_error(image.message);
  std::vector<std::byte> png(bytes.get(), bytes.get() + size);
  if (!text.key.empty()) {
    constexpr std::ptrdiff_t behind_header = 8 + 25; // the signature and IHDR
    const auto chunk = text_chunk(text);
    png.insert(png.begin() + behind_header, chunk.begin(), chunk.end());
  }
  return png;
}

} // namespace meninas
