#include "image/metrics/relative_error.h"

#include <algorithm>
#include <cmath>

namespace meninas {

double relative_error(const Image& picture, const Image& reference,
                      std::span<const std::uint8_t> left_out, const Image* variance) {
  double square = 0.0, sum = 0.0, count = 0.0;
  for (std::size_t p = 0; p < reference.pixels.size(); ++p) {
    if (!left_out.empty() && left_out[p] != 0)
      continue;
    for (int band = 0; band < 3; ++band) {
      const double b = double{reference.pixels[p][band]}, off = double{picture.pixels[p][band]} - b;
      square += off * off - (variance != nullptr ? double{variance->pixels[p][band]} : 0.0);
      sum += b;
      count += 1.0;
    }
  }
  return sum > 0.0 ? std::sqrt(std::max(square, 0.0) * count) / sum : 0.0;
}

} // namespace meninas
