// The sky as a light to be looked for: its texels, chosen by their luminance.
//
//   p(w) = P(texel) / texel's solid angle      1/sr,   P in proportion to the mean luminance there times the solid angle
//
// The mean over a texel of what is bilinear between the centres of texels is that of its
// neighbours by 1/8, 3/4, 1/8 each way: so no part of the sky that shines is left out. An even
// sky is not looked for: it is met.
#pragma once

#include "scenes/sky/environment.h"

#include <array>
#include <vector>

namespace meninas::reference {

struct SkyTable {
  std::vector<float> rows;    ///< cumulative chances up to and with each row
  std::vector<float> columns; ///< row by row, the same within the row; empty where there is no map
};

SkyTable make_sky_table(const Environment& sky);

struct SkySample {
  Direction direction{0.0};
  double density = 0.0; ///< 1/sr
};
/// Precondition: the table is not empty.
SkySample sample_sky(const Environment& sky, const SkyTable& table,
                     const std::array<float, 4>& u);
double sky_density(const Environment& sky, const SkyTable& table, const Direction& direction);

} // namespace meninas::reference
