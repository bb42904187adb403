#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
  x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
  x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
  x = ((x >> 8) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8);
  return (x >> 16) | (x << 16);
}

// The second generator matrix of Sobol's sequence is Pascal's triangle modulo 2;
// it factors into five sparse steps, one per bit of the binomials' arguments (Lucas).
constexpr std::uint32_t pascal(std::uint32_t x) {
  x ^= (x & 0xaaaaaaaaU) >> 1;
  x ^= (x & 0xccccccccU) >> 2;
  x ^= (x & 0xf0f0f0f0U) >> 4;
  x ^= (x & 0xff00ff00U) >> 8;
  x ^= (x & 0xffff0000U) >> 16;
  return x;
}

// Nested uniform scrambling on reversed bits: each bit is flipped by a hash of the bits below it
// (Laine and Karras 2011, with Vegdahl's constants).
constexpr std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

// Dimensions 2 and 3 are the first two after a relabelling of the index by an upper
// triangular matrix U over GF(2), which keeps every aligned power-of-two block,
// hence the stratification of the pair. Column m has bit m and lower bits only;
// they were found by a search that keeps the four-dimensional quality parameter
// t of the prefixes 2^m low (t = 1 to 3 up to m = 12, column by column).
constexpr std::array<std::uint32_t, 32> relabelling_columns{
    0x00000001U, 0x00000002U, 0x00000005U, 0x0000000bU, 0x00000010U, 0x00000021U, 0x00000043U,
    0x00000086U, 0x00000112U, 0x0000025dU, 0x000006f6U, 0x00000cfeU, 0x00001844U, 0x00003c91U,
    0x0000508dU, 0x0000e69bU, 0x000186e3U, 0x00035824U, 0x000425d6U, 0x00098401U, 0x001d1a4cU,
    0x0034cdabU, 0x005ba8ccU, 0x00d40880U, 0x017eb86cU, 0x03178106U, 0x0756a508U, 0x0f1c1c5cU,
    0x164a149fU, 0x3f0ccc95U, 0x606d8aedU, 0xa7656f51U,
};

using ByteTables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr ByteTables make_byte_tables() {
  ByteTables tables{};
  for (std::uint32_t byte = 0; byte < 4; ++byte)
    for (std::uint32_t value = 0; value < 256; ++value)
      for (std::uint32_t bit = 0; bit < 8; ++bit)
        if ((value >> bit) & 1U)
          tables[byte][value] ^= relabelling_columns[8 * byte + bit];
  return tables;
}

constexpr ByteTables byte_tables = make_byte_tables();

constexpr std::uint32_t relabelled(std::uint32_t index) {
  return byte_tables[0][index & 255U] ^ byte_tables[1][(index >> 8) & 255U] ^
         byte_tables[2][(index >> 16) & 255U] ^ byte_tables[3][index >> 24];
}

float coordinate(std::uint32_t unscrambled, std::uint32_t seed, std::uint32_t k) {
  const auto bits = reversed_bits(scrambled(unscrambled, mix(seed + k * 0x9e3779b9U)));
  return static_cast<float>(bits >> 8) * 0x1p-24F;
}

} // namespace

std::array<float, 4> sobol4(std::uint32_t index, std::uint32_t seed) {
  // Sobol's integers are bit-reversed, and so is what the scrambling works on:
  // both reversals cancel.
  const auto second = relabelled(index);
  const std::array<std::uint32_t, 4> unscrambled{index, pascal(index), second, pascal(second)};

  std::array<float, 4> point{};
  for (std::uint32_t k = 0; k < 4; ++k)
    point[k] = coordinate(unscrambled[k], seed, k);
  return point;
}

glm::vec2 sobol2(std::uint32_t index, std::uint32_t seed, SobolPair pair) {
  const auto k = static_cast<std::uint32_t>(pair);
  const auto first = pair == SobolPair::first ? index : relabelled(index);
  return {coordinate(first, seed, k), coordinate(pascal(first), seed, k + 1)};
}

glm::vec2 concentric_disc(float u, float v) {
  const auto x = 2.0F * u - 1.0F;
  const auto y = 2.0F * v - 1.0F;
  if (x == 0.0F && y == 0.0F)
    return {0.0F, 0.0F};

  // Squares about the centre become circles of the same share of the area.
  constexpr auto quarter = std::numbers::pi_v<float> / 4.0F;
  const auto wide = std::abs(x) > std::abs(y);
  const auto radius = wide ? x : y;
  const auto angle = wide ? quarter * (y / x) : 2.0F * quarter - quarter * (x / y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

glm::vec3 cosine_hemisphere(float u, float v) {
  const auto p = concentric_disc(u, v);
  // The height on the unit sphere;
  // the floor keeps the direction off the plane where rounding has eaten it.
  const auto z = std::sqrt(std::max(1e-7F, 1.0F - p.x * p.x - p.y * p.y));
  return {p.x, p.y, z};
}

TangentFrame tangent_frame(const Direction& n) {
  const auto sign = std::copysign(1.0, n.z);
  const auto a = -1.0 / (sign + n.z);
  const auto b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

} // namespace meninas
