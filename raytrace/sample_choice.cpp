#include "raytrace/sample_choice.h"

#include <algorithm>

namespace meninas {

SampleRange first_samples(const RenderSettings& settings) {
  constexpr int fewest = 4, part = 4;
  const int all = std::max(settings.samples, 1);
  return {0, settings.pixel_error > 0.0 ? std::min(all, std::max(fewest, all / part)) : all};
}

SampleRange rest_samples(const RenderSettings& settings) {
  const int first = first_samples(settings).count;
  return {first, std::max(settings.samples, 1) - first};
}

PixelMask differing_pixels(const Image& picture, double pixel_error) {
  constexpr double dark = 0.05; // of the mean: differences in black corners are not seen
  double mean = 0.0;
  for (const glm::vec3& pixel : picture.pixels)
    mean += double{pixel.r + pixel.g + pixel.b} / (3.0 * double(picture.pixels.size()));
  const auto differ = [&](const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 seen = glm::max(a, b) + static_cast<float>(dark * mean);
    return glm::any(glm::greaterThan(glm::abs(a - b), static_cast<float>(pixel_error) * seen));
  };
  PixelMask worth(picture.pixels.size(), 0);
  // Each pair of neighbours once: to the right and the three below.
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || nx >= picture.width || ny >= picture.height ||
            !differ(picture.at(x, y), picture.at(nx, ny)))
          continue;
        worth[static_cast<std::size_t>(y * picture.width + x)] = 1;
        worth[static_cast<std::size_t>(ny * picture.width + nx)] = 1;
      }
  return worth;
}

} // namespace meninas
