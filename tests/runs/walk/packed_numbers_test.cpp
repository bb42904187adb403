// Tables of a page: what is packed comes back, and small differences pack small.
#include "runs/walk/packed_numbers.h"

#include "tests/runs/walk/unpacked.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>

namespace meninas {
namespace {

using test::unpacked;

TEST(PackedNumbers, ComeBackWhateverTheyAre) {
  const std::vector<std::uint32_t> small{5, 900, 6, 901, 4, 899}, wild{0, 0xffffffffU, 7, 0x80000000U};
  PackedNumbers packed;
  add_table(packed, "small", small, 2);
  add_table(packed, "wild", wild, 1);
  EXPECT_EQ(unpacked(packed, 0), small);
  EXPECT_EQ(unpacked(packed, 1), wild);
  EXPECT_EQ(packed.tables[0].bytes_each, 2U) << "1800 is the largest of them, folded";
  EXPECT_EQ(packed.tables[1].bytes_each, 4U);
}

TEST(PackedNumbers, AnEvenRowOfNumbersIsNearlyNothing) {
  std::vector<std::uint32_t> even;
  for (std::uint32_t k = 0; k < 30'000; ++k)
    even.push_back(17 * k);
  PackedNumbers packed;
  add_table(packed, "even", even, 1);
  EXPECT_EQ(packed.bytes.size(), 30'000U);
  EXPECT_LT(deflated(packed.bytes).size(), 100U);
}

TEST(PackedNumbers, DeflatedBytesAreThoseOfZlib) {
  std::vector<std::byte> bytes;
  for (int k = 0; k < 1000; ++k)
    bytes.push_back(static_cast<std::byte>(k * k & 0xff));
  const std::vector<std::byte> packed = deflated(bytes);
  std::vector<std::byte> back(bytes.size());
  uLongf size = back.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(back, bytes);
}

TEST(PackedNumbers, HalvesAreThoseOfIeee754) {
  EXPECT_EQ(half_bits(1.0F), 0x3c00U);
  EXPECT_EQ(half_bits(-2.0F), 0xc000U);
  EXPECT_EQ(half_bits(1e9F), 0x7bffU) << "the largest number, no infinity";
  EXPECT_EQ(half_bits(std::nanf("")), 0U);
}

TEST(PackedNumbers, StepsAreRoundedToTheNearest) {
  EXPECT_EQ(in_steps(0.74, 0.5), 1U);
  EXPECT_EQ(in_steps(-0.76, 0.5), static_cast<std::uint32_t>(-2));
  EXPECT_EQ(in_steps(1e300, 1.0), 0x7fffffffU);
  EXPECT_EQ(in_steps(std::numeric_limits<double>::quiet_NaN(), 1.0), 0U);
}

} // namespace
} // namespace meninas
