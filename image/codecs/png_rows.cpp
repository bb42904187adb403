#include "image/codecs/png_rows.h"

#define ZLIB_CONST // what is read stays as it is
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace meninas::decoder {

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t big_endian(std::string_view four) {
  std::uint32_t value = 0;
  for (const char c : four.substr(0, 4))
    value = value << 8U | static_cast<std::uint8_t>(c);
  return value;
}

/// Depths by colour type, PNG specification, table 11.1.
static bool has_depth(std::uint32_t colour_type, std::uint32_t depth) {
  const bool small = depth == 1 || depth == 2 || depth == 4;
  switch (colour_type) {
  case grey_png:
    return small || depth == 8 || depth == 16;
  case palette_png:
    return small || depth == 8;
  case rgb_png:
  case 4:
  case 6:
    return depth == 8 || depth == 16;
  default:
    return false;
  }
}

PngHeader png_header(std::string_view bytes) {
  const auto at = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes[k]); };
  const PngHeader header{big_endian(bytes), big_endian(bytes.substr(4)), at(8), at(9), at(12) == 1};
  constexpr std::uint32_t largest = 1000000; // that libpng reads
  if (header.width == 0 || header.height == 0)
    throw std::runtime_error("the PNG has no size");
  if (header.width > largest || header.height > largest)
    throw std::runtime_error(std::to_string(header.width) + " x " + std::to_string(header.height) +
                             " pixels are too many");
  if (!has_depth(header.colour_type, header.depth) || at(10) != 0 || at(11) != 0 || at(12) > 1)
    throw std::runtime_error("the PNG has a header that no PNG may have");
  return header;
}

namespace {

struct Rows {
  std::uint64_t count = 0;
  std::uint64_t bytes = 0; ///< of each, with its filter
};

/// In the order of the file. Interlaced they come in seven passes,
/// each a coarser picture of its own (PNG specification, 8.2).
std::vector<Rows> rows_of(const PngHeader& header) {
  constexpr std::array<std::uint64_t, 7> channels{1, 0, 3, 1, 2, 0, 4};
  const auto rows = [&](std::uint64_t width, std::uint64_t height) {
    const auto bits = width * channels.at(header.colour_type) * header.depth;
    return Rows{width == 0 ? 0 : height, 1 + (bits + 7) / 8};
  };
  if (!header.interlaced)
    return {rows(header.width, header.height)};
  struct Pass {
    std::uint64_t x, y, dx, dy;
  };
  constexpr std::array<Pass, 7> passes{{{0, 0, 8, 8},
                                        {4, 0, 8, 8},
                                        {0, 4, 4, 8},
                                        {2, 0, 4, 4},
                                        {0, 2, 2, 4},
                                        {1, 0, 2, 2},
                                        {0, 1, 1, 2}}};
  const auto steps = [](std::uint64_t size, std::uint64_t first, std::uint64_t step) {
    return size <= first ? 0 : (size - first + step - 1) / step;
  };
  std::vector<Rows> all;
  for (const Pass& pass : passes)
    all.push_back(
        rows(steps(header.width, pass.x, pass.dx), steps(header.height, pass.y, pass.dy)));
  return all;
}

/// Counts rows and looks at the first byte of each as the bytes go by.
class RowCheck {
public:
  explicit RowCheck(const PngHeader& header) : rows_(rows_of(header)) { next_row(); }

  bool complete() const { return at_ == rows_.size(); }

  void pass(const unsigned char* bytes, std::size_t count) {
    constexpr unsigned char last_filter = 4;
    while (count > 0 && !complete()) {
      const auto& row = rows_[at_];
      if (left_ == row.bytes && *bytes > last_filter)
        throw std::runtime_error("the PNG is damaged: a row has a filter that does not exist");
      const auto taken = std::min<std::uint64_t>(count, left_);
      bytes += taken;
      count -= taken;
      left_ -= taken;
      if (left_ > 0)
        continue;
      left_ = row.bytes;
      if (++row_ == row.count) {
        ++at_;
        next_row();
      }
    }
  }

private:
  void next_row() {
    while (!complete() && rows_[at_].count == 0)
      ++at_;
    row_ = 0;
    left_ = complete() ? 0 : rows_[at_].bytes;
  }

  std::vector<Rows> rows_;
  std::size_t at_ = 0;
  std::uint64_t row_ = 0;
  std::uint64_t left_ = 0;
};

} // namespace

void check_png_rows(std::string_view png) {
  std::string_view rest = png.substr(png_signature);
  RowCheck check(png_header(rest.substr(png_length_and_type)));
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, inflateEnd);

  std::vector<unsigned char> buffer(std::size_t{1} << 16);
  int state = Z_OK;
  while (!rest.empty() && state == Z_OK && !check.complete()) {
    const std::size_t length = big_endian(rest);
    const auto type = rest.substr(4, 4);
    const auto data = rest.substr(png_length_and_type, length);
    rest.remove_prefix(png_length_and_type + length + png_checksum);
    if (type != "IDAT" || length == 0)
      continue;
    stream.next_in = reinterpret_cast<const Bytef*>(data.data());
    stream.avail_in = static_cast<uInt>(length);
    do {
      stream.next_out = buffer.data();
      stream.avail_out = static_cast<uInt>(buffer.size());
      state = inflate(&stream, Z_NO_FLUSH);
      check.pass(buffer.data(), buffer.size() - stream.avail_out);
    } while (state == Z_OK && stream.avail_out == 0 && !check.complete());
    if (state == Z_BUF_ERROR) // all of this chunk is used up
      state = Z_OK;
  }
  if (state != Z_OK && state != Z_STREAM_END)
    throw std::runtime_error("the PNG is damaged: its pixels cannot be decompressed");
  if (!check.complete())
    throw std::runtime_error("the PNG ends too early");
}

} // namespace meninas::decoder
