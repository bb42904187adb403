// Columns of whole numbers, packed small for a page that unpacks them in a few lines
// (page/unpack.js).
//
// A table of n rows and w columns is kept as the differences from row to row, modulo 2^32, folded so
// that small ones of either sign are small numbers:
//
//   z = 2 d where d >= 0, else -2 d - 1
//
// their lowest bytes first, column by column, then the second lowest, and so on, as many as any needs.
// All tables of a page are deflated together (RFC 1950).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace meninas {

/// Where a table is among the bytes, and how to read it.
struct PackedTable {
  std::string name;
  std::size_t rows = 0, columns = 1, bytes_each = 1;
};

struct PackedNumbers {
  std::vector<PackedTable> tables; ///< in the order of their bytes
  std::vector<std::byte> bytes;    ///< not deflated
};

/// `values` row by row; their number is a multiple of `columns`.
void add_table(PackedNumbers& packed, const std::string& name,
               std::span<const std::uint32_t> values, std::size_t columns);

/// The effort of packing: for a file that is kept, or for one that is waited for.
enum class PackedSize { smallest, quick };

/// RFC 1950, as DecompressionStream("deflate") takes it.
std::vector<std::byte> deflated(std::span<const std::byte> bytes, PackedSize size = PackedSize::smallest);

/// x as a whole number of `step`s, which may be negative; what is no number is 0, what is too large
/// the largest there is.
std::uint32_t in_steps(double x, double step);

/// The bits of IEEE 754 binary16 nearest to x; beyond its largest number, that.
std::uint32_t half_bits(float x);

} // namespace meninas
