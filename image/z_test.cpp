#include "image/z_test.h"

#include "scenes/types.h"

#include <algorithm>
#include <cmath>

namespace meninas {

double z_figure(const Image& picture, const Image& mean, const Image& variance) {
  expects(picture.pixels.size() == mean.pixels.size() &&
              picture.pixels.size() == variance.pixels.size() && !picture.pixels.empty(),
          "pictures that are compared have one size");
  double level = 0.0;
  for (const glm::vec3& pixel : mean.pixels)
    level += (std::abs(pixel.r) + std::abs(pixel.g) + std::abs(pixel.b)) / 3.0;
  level /= static_cast<double>(mean.pixels.size());

  constexpr double half_precision = 0x1p-11;
  std::vector<double> z;
  z.reserve(3 * picture.pixels.size());
  for (std::size_t k = 0; k < picture.pixels.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(double{picture.pixels[k][c]} - mean.pixels[k][c]);
      const double rounding = half_precision * std::hypot(mean.pixels[k][c], level);
      const double deviation =
          std::sqrt(std::max(double{variance.pixels[k][c]}, 0.0) + rounding * rounding);
      z.push_back(difference > 0.0 ? difference / deviation : 0.0);
    }
  const auto rank =
      static_cast<std::ptrdiff_t>((1.0 - z_outliers) * static_cast<double>(z.size() - 1));
  std::nth_element(z.begin(), z.begin() + rank, z.end());
  return z[static_cast<std::size_t>(rank)];
}

} // namespace meninas
