// Low-discrepancy samples that depend on nothing but their key:
// the same bits for any thread count and any run.
//
// Points are Sobol's sequence with Owen scrambling by hashing (Laine and Karras 2011, Burley 2020):
// any power-of-two prefix is stratified in every elementary interval of base 2,
// also per pair of dimensions (0, 1) and (2, 3).
#pragma once

#include "scenes/types.h"

#include <array>

namespace meninas {

/// A bijection that changes about half of the bits wherever one
/// is changed (by multiplications and shifts, after Wellons).
constexpr std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x21f0aaadU;
  x ^= x >> 15;
  x *= 0x735a2d97U;
  x ^= x >> 15;
  return x;
}

/// A well-mixed hash of its arguments, for seeds.
constexpr std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0) {
  std::uint32_t h = mix(a + 0x9e3779b9U);
  h = mix(h ^ (b + 0x85ebca6bU));
  return mix(h ^ (c + 0xc2b2ae35U));
}

/// Point `index` of the scrambled four-dimensional Sobol sequence that belongs to `seed`;
/// each coordinate in [0, 1).
std::array<float, 4> sobol4(std::uint32_t index, std::uint32_t seed);

/// Coordinates 0 and 1 of that point, or 2 and 3, in half of the time.
enum class SobolPair : std::uint32_t { first = 0, second = 2 };
glm::vec2 sobol2(std::uint32_t index, std::uint32_t seed, SobolPair pair);

/// Maps the unit square to the unit disc,
/// preserving area fractions and neighbourhoods (Shirley and Chiu 1997).
glm::vec2 concentric_disc(float u, float v);

/// A direction about +z with density cos(theta) / pi (Malley's method).
glm::vec3 cosine_hemisphere(float u, float v);

/// Two tangents that make a right-handed orthonormal frame with the unit vector n (Duff et al.
/// 2017).
struct TangentFrame {
  Direction tangent;
  Direction bitangent;
};
TangentFrame tangent_frame(const Direction& n);

} // namespace meninas
