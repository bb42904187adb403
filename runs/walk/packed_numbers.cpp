#include "runs/walk/packed_numbers.h"

#include "scenes/types.h"

#include <glm/gtc/packing.hpp>
#include <zlib.h>

#include <cmath>
#include <limits>

namespace meninas {

/// Small for small differences of either sign.
static std::uint32_t folded(std::uint32_t difference) {
  const bool negative = (difference & 0x80000000U) != 0;
  return negative ? 2U * ~difference + 1U : 2U * difference;
}

void add_table(PackedNumbers& packed, const std::string& name,
               std::span<const std::uint32_t> values, std::size_t columns) {
  expects(columns > 0 && values.size() % columns == 0, "a table has whole rows");
  PackedTable table{name, values.size() / columns, columns, 1};
  std::vector<std::uint32_t> differences(values.size());
  std::uint32_t any = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    differences[k] = folded(values[k] - (k < columns ? 0U : values[k - columns]));
    any |= differences[k];
  }
  while (table.bytes_each < 4 && any >> (8 * table.bytes_each) != 0)
    ++table.bytes_each;
  for (std::size_t byte = 0; byte < table.bytes_each; ++byte)
    for (std::size_t column = 0; column < columns; ++column)
      for (std::size_t row = 0; row < table.rows; ++row)
        packed.bytes.push_back(
            static_cast<std::byte>(differences[row * columns + column] >> (8 * byte) & 0xffU));
  packed.tables.push_back(std::move(table));
}

std::vector<std::byte> deflated(std::span<const std::byte> bytes, PackedSize packed) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> result(size);
  const int outcome =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                packed == PackedSize::quick ? Z_BEST_SPEED : Z_BEST_COMPRESSION);
  expects(outcome == Z_OK, "there is room for what is deflated");
  result.resize(size);
  return result;
}

std::uint32_t in_steps(double x, double step) {
  if (std::isnan(x))
    return 0;
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::lround(std::clamp(x / step, -most, most))));
}

std::uint32_t half_bits(float x) {
  constexpr float largest = 65504.0F;
  return glm::packHalf1x16(std::clamp(std::isnan(x) ? 0.0F : x, -largest, largest));
}

} // namespace meninas
