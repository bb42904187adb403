// One number per pixel, and sums of it over neighbourhoods.
#pragma once

#include <cstddef>
#include <vector>

namespace meninas {

struct Channel {
  int width = 0;
  int height = 0;
  std::vector<float> values; ///< width * height, row by row from the top

  Channel() = default;
  Channel(int width, int height);

  float& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
  float at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
};

double mean_of(const Channel& channel);

/// 2 r + 1 weights for the offsets -r ... r.
using Kernel = std::vector<double>;

/// exp(-k^2 / (2 deviation^2)) for k = -radius ... radius, not normalised.
Kernel gaussian(int radius, double deviation);

/// out(x, y) = sum_j along_y[j] sum_i along_x[i] channel(x + i, y + j);
/// beyond the border the channel goes on with its border's values.
Channel weighted_sums(const Channel& channel, const Kernel& along_x, const Kernel& along_y);

} // namespace meninas
