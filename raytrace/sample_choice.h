// Adaptive pixel sampling: which pixels are worth all samples (after Kirk and Arvo 1991, in two stages).
//
// Every pixel takes its first samples, a quarter of all and at least four. Where a pixel and one of its eight neighbours then differ in some
// channel by more than `pixel_error`,
//   |a - b| > pixel_error (max(a, b) + 0.05 mean of the picture),
// both take the rest; the others keep the mean of their first. The choice is made of whole pictures, so that it depends on no tile and no
// thread, and of the whole light, so that all layers are of the same samples. What is smaller than the first samples show is not found.
#pragma once

#include "raytrace/tiles.h"

namespace meninas {

/// Samples that every pixel takes: all where sampling is not adaptive.
SampleRange first_samples(const RenderSettings& settings);

/// The rest; its count is 0 where sampling is not adaptive.
SampleRange rest_samples(const RenderSettings& settings);

/// 1 where neighbouring pixels differ by more than `pixel_error`.
PixelMask differing_pixels(const Image& picture, double pixel_error);

/// The mean over all samples, from those over the first and over the rest.
inline glm::vec3 blended(const RenderSettings& settings, const glm::vec3& first,
                         const glm::vec3& rest) {
  const float share =
      static_cast<float>(rest_samples(settings).count) / static_cast<float>(settings.samples);
  return first + share * (rest - first);
}

} // namespace meninas
