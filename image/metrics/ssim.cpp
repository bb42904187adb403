#include "image/metrics/ssim.h"

#include "image/display.h"
#include "scenes/types.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas {
namespace {

constexpr int radius = 5;
constexpr double deviation = 1.5;
constexpr double c1 = 0.01 * 0.01;
constexpr double c2 = 0.03 * 0.03;

Kernel window() {
  Kernel kernel = gaussian(radius, deviation);
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel)
    weight /= sum;
  return kernel;
}

Channel grey_values(const Image& picture) {
  Channel grey(picture.width, picture.height);
  std::ranges::transform(picture.pixels, grey.values.begin(), [](const glm::vec3& pixel) {
    const glm::vec3 clipped = glm::clamp(pixel, 0.0F, 1.0F);
    return srgb_encode(glm::dot(clipped, glm::vec3(0.2126F, 0.7152F, 0.0722F)));
  });
  return grey;
}

Channel products(const Channel& a, const Channel& b) {
  Channel result(a.width, a.height);
  std::ranges::transform(a.values, b.values, result.values.begin(), std::multiplies<>());
  return result;
}

} // namespace

Channel ssim_map(const Image& a, const Image& b) {
  expects(a.width == b.width && a.height == b.height, "pictures that are compared have one size");
  const Kernel w = window();
  const Channel grey_a = grey_values(a), grey_b = grey_values(b);
  const auto mean = [&](const Channel& channel) { return weighted_sums(channel, w, w); };
  const Channel mean_a = mean(grey_a), mean_b = mean(grey_b);
  const Channel mean_aa = mean(products(grey_a, grey_a)), mean_bb = mean(products(grey_b, grey_b));
  const Channel mean_ab = mean(products(grey_a, grey_b));

  Channel map(a.width, a.height);
  for (std::size_t k = 0; k < map.values.size(); ++k) {
    const double mu_a = mean_a.values[k], mu_b = mean_b.values[k];
    // Differences of floats in [0, 1] are wrong by 1e-7,
    // which C2 makes an error of 1e-4 at most in SSIM. As variances they have to be
    // of one distribution, so that equal pictures are equal to the bit.
    const double variance_a = std::max(mean_aa.values[k] - mu_a * mu_a, 0.0);
    const double variance_b = std::max(mean_bb.values[k] - mu_b * mu_b, 0.0);
    const double most = std::sqrt(variance_a * variance_b);
    const double covariance = std::clamp(mean_ab.values[k] - mu_a * mu_b, -most, most);
    map.values[k] =
        static_cast<float>((2.0 * mu_a * mu_b + c1) * (2.0 * covariance + c2) /
                           ((mu_a * mu_a + mu_b * mu_b + c1) * (variance_a + variance_b + c2)));
  }
  return map;
}

double mean_ssim(const Channel& map) {
  if (map.width <= 2 * radius || map.height <= 2 * radius)
    return mean_of(map);
  double sum = 0.0;
  for (int y = radius; y < map.height - radius; ++y)
    for (int x = radius; x < map.width - radius; ++x)
      sum += map.at(x, y);
  return sum / (static_cast<double>(map.width - 2 * radius) * (map.height - 2 * radius));
}

} // namespace meninas
