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

static void add_text(const PngText& text, std::vector<std::byte>& png) {
  if (text.key.empty())
    return;
  constexpr std::ptrdiff_t behind_header = 8 + 25; // the signature and IHDR
  const auto chunk = text_chunk(text);
  png.insert(png.begin() + behind_header, chunk.begin(), chunk.end());
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
  add_text(text, png);
  return png;
}

// --- 16 bits: the library's simple interface has them for linear light alone

namespace {

struct Written {
  std::vector<std::byte> png;
  std::string error;
};

void append(png_structp png, png_bytep bytes, std::size_t count) {
  auto& written = *static_cast<Written*>(png_get_io_ptr(png));
  const auto first = reinterpret_cast<const std::byte*>(bytes);
  written.png.insert(written.png.end(), first, first + count);
}

[[noreturn]] void fail_png(png_structp png, png_const_charp reason) {
  static_cast<Written*>(png_get_error_ptr(png))->error = reason;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

/// False where the library has jumped out of it. Nothing here may need a destructor.
bool write_rows(png_structp png, png_infop info, png_uint_32 width, png_uint_32 height,
                const png_byte* codes) {
  if (setjmp(png_jmpbuf(png)) != 0)
    return false;
  constexpr int depth = 16;
  png_set_IHDR(png, info, width, height, depth, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  const std::size_t row = std::size_t{6} * width;
  for (png_uint_32 y = 0; y < height; ++y)
    png_write_row(png, codes + y * row);
  png_write_end(png, info);
  return true;
}

} // namespace

std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint16_t> codes,
                                  Compression compression, const PngText& text) {
  std::vector<png_byte> big_endian;
  big_endian.reserve(2 * codes.size());
  for (const std::uint16_t code : codes) {
    big_endian.push_back(static_cast<png_byte>(code >> 8));
    big_endian.push_back(static_cast<png_byte>(code & 0xff));
  }
  Written written;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &written, fail_png, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool is_whole = false;
  if (info != nullptr) {
    png_set_write_fn(png, &written, append, nullptr);
    if (compression == Compression::quick)
      png_set_compression_level(png, Z_BEST_SPEED);
    is_whole = write_rows(png, info, static_cast<png_uint_32>(width),
                          static_cast<png_uint_32>(height), big_endian.data());
  }
  png_destroy_write_struct(&png, &info);
  if (!is_whole)
    throw std::runtime_error(written.error.empty() ? "no memory for a PNG" : written.error);
  add_text(text, written.png);
  return std::move(written.png);
}

} // namespace meninas
