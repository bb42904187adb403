#include "scenes/gallery/generator/picture_file.h"

#include <algorithm>
#include <string_view>

namespace meninas::gallery {

namespace {

using Bytes = std::vector<std::uint8_t>;

void append_big_endian(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// PNG specification, annex D.
std::uint32_t crc(const Bytes& bytes) {
  std::uint32_t rest = ~0U;
  for (const std::uint8_t byte : bytes) {
    rest ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      rest = rest >> 1U ^ (rest & 1U ? 0xedb88320U : 0U);
  }
  return ~rest;
}

/// Length, type and data, and the check over the latter two.
void append_chunk(Bytes& file, std::string_view type, const Bytes& data) {
  append_big_endian(file, static_cast<std::uint32_t>(data.size()));
  Bytes checked(type.begin(), type.end());
  checked.insert(checked.end(), data.begin(), data.end());
  file.insert(file.end(), checked.begin(), checked.end());
  append_big_endian(file, crc(checked));
}

/// A zlib stream (RFC 1950) of stored blocks (RFC 1951, 3.2.4).
Bytes stored(const Bytes& data) {
  constexpr std::size_t longest = 65535;
  Bytes stream{0x78, 0x01};
  for (std::size_t first = 0; first < data.size(); first += longest) {
    const std::size_t size = std::min(longest, data.size() - first);
    stream.push_back(first + size == data.size() ? 1 : 0);
    for (const std::size_t word : {size, ~size})
      for (int shift = 0; shift < 16; shift += 8)
        stream.push_back(static_cast<std::uint8_t>(word >> shift));
    const auto from = data.begin() + static_cast<std::ptrdiff_t>(first);
    stream.insert(stream.end(), from, from + static_cast<std::ptrdiff_t>(size));
  }
  std::uint32_t a = 1, b = 0; // Adler-32
  for (const std::uint8_t byte : data) {
    a = (a + byte) % 65521U;
    b = (b + a) % 65521U;
  }
  append_big_endian(stream, b << 16U | a);
  return stream;
}

} // namespace

std::vector<std::uint8_t> png_bytes(const Picture& picture) {
  Bytes header;
  append_big_endian(header, static_cast<std::uint32_t>(picture.width));
  append_big_endian(header, static_cast<std::uint32_t>(picture.height));
  header.insert(header.end(), {8, 3, 0, 0, 0}); // eight bits, indexed
  Bytes colours, alphas, rows;
  for (const auto& [r, g, b, alpha] : picture.palette) {
    colours.insert(colours.end(), {r, g, b});
    alphas.push_back(alpha);
  }
  for (int y = 0; y < picture.height; ++y) {
    rows.push_back(0); // unfiltered
    const auto row = picture.texels.begin() + y * picture.width;
    rows.insert(rows.end(), row, row + picture.width);
  }
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk(file, "IHDR", header);
  append_chunk(file, "PLTE", colours);
  append_chunk(file, "tRNS", alphas);
  append_chunk(file, "IDAT", stored(rows));
  append_chunk(file, "IEND", {});
  return file;
}

} // namespace meninas::gallery
