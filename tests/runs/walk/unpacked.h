// Tables of a page as page/unpack.js reads them.
#pragma once

#include "runs/walk/packed_numbers.h"

#include <algorithm>
#include <string_view>

namespace meninas::test {

inline std::vector<std::uint32_t> unpacked(const PackedNumbers& packed, std::size_t which) {
  std::size_t place = 0;
  for (std::size_t t = 0; t < which; ++t)
    place += packed.tables[t].rows * packed.tables[t].columns * packed.tables[t].bytes_each;
  const PackedTable& table = packed.tables[which];
  std::vector<std::uint32_t> values(table.rows * table.columns, 0);
  for (std::size_t byte = 0; byte < table.bytes_each; ++byte)
    for (std::size_t column = 0; column < table.columns; ++column)
      for (std::size_t k = column; k < values.size(); k += table.columns)
        values[k] |= std::to_integer<std::uint32_t>(packed.bytes[place++]) << (8 * byte);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint32_t folded = values[k];
    const std::uint32_t difference = (folded & 1U) != 0 ? ~(folded >> 1U) : folded >> 1U;
    values[k] = difference + (k < table.columns ? 0U : values[k - table.columns]);
  }
  return values;
}

/// The table of that name; empty where there is none.
inline std::vector<std::uint32_t> unpacked(const PackedNumbers& packed, std::string_view name) {
  const auto table = std::ranges::find(packed.tables, name, &PackedTable::name);
  return table == packed.tables.end()
             ? std::vector<std::uint32_t>{}
             : unpacked(packed, static_cast<std::size_t>(table - packed.tables.begin()));
}

} // namespace meninas::test
