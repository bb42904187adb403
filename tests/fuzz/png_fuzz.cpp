// What libFuzzer throws at the reader of PNGs: any bytes end as pixels between 0 and 1, as many as the header says,
// or as one line. Checksums are mended after each mutation, or nothing but they would be tried.
#include "image/codecs/png_decoding.h"

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace meninas;

constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
constexpr std::int64_t few = 1 << 22; // values: larger pictures are refused, as too large ones are

void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "finding: %s\n", what);
    std::abort();
  }
}

void refuse_large(const decoder::PngShape& shape) {
  require(shape.width > 0 && shape.height > 0, "a picture without pixels");
  require(shape.channels >= 1 && shape.channels <= 4, "a number of channels");
  if (std::int64_t{shape.width} * shape.height > few / shape.channels)
    throw std::runtime_error("too large");
}

void mend_checksums(std::uint8_t* data, std::size_t size) {
  for (std::size_t at = signature; at + length_and_type + checksum <= size;) {
    const std::size_t length = std::size_t{data[at]} << 24 | std::size_t{data[at + 1]} << 16 |
                               std::size_t{data[at + 2]} << 8 | data[at + 3];
    if (length > size - at - length_and_type - checksum)
      return;
    const auto sum = static_cast<std::uint32_t>(crc32_z(0, data + at + 4, 4 + length));
    std::uint8_t* const place = data + at + length_and_type + length;
    for (int k = 0; k < 4; ++k)
      place[k] = static_cast<std::uint8_t>(sum >> (24 - 8 * k));
    at += length_and_type + length + checksum;
  }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, max_size);
  if (seed % 8 != 0)
    mend_checksums(data, mutated);
  return mutated;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const decoder::DecodedPng png =
        decoder::decode_png({reinterpret_cast<const char*>(data), size}, refuse_large);
    const auto values = static_cast<std::size_t>(png.shape.width) *
                        static_cast<std::size_t>(png.shape.height * png.shape.channels);
    require(std::all_of(png.pixels.get(), png.pixels.get() + values,
                        [](float value) { return value >= 0.0F && value <= 1.0F; }),
            "a value beyond 1");
  } catch (const std::runtime_error& error) {
    const std::string line = error.what();
    require(!line.empty() && line.find('\n') == std::string::npos, "an error that is no line");
  }
  return 0;
}
