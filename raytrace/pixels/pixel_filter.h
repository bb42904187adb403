// Pixel filters: how much a place of the picture counts in a pixel near it.
// The pixel is the integral of w(x) w(y) L,
// x and y its distance from the pixel's middle in pixels, the integral of w being one:
//
//   box               1 within half a pixel: the mean over the pixel
//   tent              1 - |x| within one pixel
//   gaussian          exp(-2 x^2) within 1.5 pixels, less its value there
//   blackman-harris   0.35875 + 0.48829 cos(a) + 0.14128 cos(2 a) + 0.01168 cos(3 a), a = pi x / 1.5, within 1.5 pixels (Harris 1978)
//
// They are sampled (Ernst, Stamminger, Greiner 2006, "Filter importance sampling"):
// samples are where the filter is, as densely as it is high, and count alike. So weights sum
// to one in every pixel, pixels do not share samples, and layers add up as they do without.
#pragma once

#include <array>
#include <string_view>

namespace meninas {

enum class PixelFilter { box, tent, gaussian, blackman_harris };
inline constexpr std::array pixel_filters{PixelFilter::box, PixelFilter::tent,
                                          PixelFilter::gaussian, PixelFilter::blackman_harris};

/// "blackman-harris"
std::string_view name_of(PixelFilter filter);

/// w(x)
double filter_weight(PixelFilter filter, double x);

/// The places below which k / filter_steps of the filter's weight is, k = 0 ...
/// filter_steps, in pixels from the pixel's left or upper edge.
inline constexpr std::size_t filter_steps = 256;
using FilterPlaces = std::array<float, filter_steps + 1>;
FilterPlaces filter_places(PixelFilter filter);

/// Where a sample u in [0, 1) lies.
inline float place_of(const FilterPlaces& places, float u) {
  const float step = u * static_cast<float>(filter_steps);
  const auto k = static_cast<std::size_t>(step);
  return places[k] + (step - static_cast<float>(k)) * (places[k + 1] - places[k]);
}

} // namespace meninas
