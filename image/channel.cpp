#include "image/channel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meninas {

Channel::Channel(int w, int h)
    : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

double mean_of(const Channel& channel) {
  double sum = 0.0;
  for (const float value : channel.values)
    sum += value;
  return sum / static_cast<double>(channel.values.size());
}

Kernel gaussian(int radius, double deviation) {
  Kernel kernel;
  for (int k = -radius; k <= radius; ++k)
    kernel.push_back(std::exp(-0.5 * k * k / (deviation * deviation)));
  return kernel;
}

Channel weighted_sums(const Channel& channel, const Kernel& along_x, const Kernel& along_y) {
  const int width = channel.width, height = channel.height;
  const int x_radius = static_cast<int>(along_x.size() / 2);
  const int y_radius = static_cast<int>(along_y.size() / 2);
  Channel rows(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    // The row with its ends repeated needs no test of bounds in the sum.
    std::vector<float> padded(static_cast<std::size_t>(width + 2 * x_radius));
    for (int x = -x_radius; x < width + x_radius; ++x)
      padded[static_cast<std::size_t>(x + x_radius)] = channel.at(std::clamp(x, 0, width - 1), y);
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (std::size_t i = 0; i < along_x.size(); ++i)
        sum += along_x[i] * padded[static_cast<std::size_t>(x) + i];
      rows.at(x, y) = static_cast<float>(sum);
    }
  });
  Channel result(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<double> sums(static_cast<std::size_t>(width), 0.0);
    for (int j = -y_radius; j <= y_radius; ++j) {
      const int row = std::clamp(y + j, 0, height - 1);
      const double weight = along_y[static_cast<std::size_t>(j + y_radius)];
      for (int x = 0; x < width; ++x)
        sums[static_cast<std::size_t>(x)] += weight * rows.at(x, row);
    }
    for (int x = 0; x < width; ++x)
      result.at(x, y) = static_cast<float>(sums[static_cast<std::size_t>(x)]);
  });
  return result;
}

} // namespace meninas
