#include "image/display.h"

#include "scenes/types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace meninas {

// --- sRGB

static double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

static double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

float srgb_encode(float linear) {
  if (!(linear > 0.0F))
    return 0.0F;
  if (linear >= 1.0F)
    return 1.0F;
  return static_cast<float>(linear_to_srgb(linear));
}

float srgb_decode(float encoded) {
  if (!(encoded > 0.0F))
    return 0.0F;
  if (encoded >= 1.0F)
    return 1.0F;
  return static_cast<float>(srgb_to_linear(encoded));
}

/// One code value for each channel of each pixel, as it is shown.
template <typename Code>
static std::vector<Code> shown_codes(const Image& picture, double exposure, ViewTransform transform,
                                     std::span<const ShownPixel> instead,
                                     const std::function<Code(double)>& code_of) {
  expects(std::isfinite(exposure), "an exposure is finite");
  const double scale = std::exp2(exposure);
  std::vector<Code> codes;
  codes.reserve(3 * picture.pixels.size());
  for (const auto& pixel : picture.pixels) {
    glm::dvec3 exposed(0.0);
    for (int c = 0; c < 3; ++c) {
      expects(!std::isnan(pixel[c]), "no displayed value is NaN");
      if (pixel[c] > 0.0F)
        exposed[c] = std::min(pixel[c], std::numeric_limits<float>::max()) * scale;
    }
    const glm::dvec3 shown = displayed(transform, exposed);
    for (int c = 0; c < 3; ++c)
      codes.push_back(code_of(shown[c]));
  }
  for (const ShownPixel& other : instead)
    for (int c = 0; c < 3; ++c)
      codes.at(3 * other.pixel + static_cast<std::size_t>(c)) = code_of(double{other.shown[c]});
  return codes;
}

std::vector<std::uint8_t> display_codes(const Image& picture, double exposure,
                                        ViewTransform transform, std::span<const ShownPixel> instead) {
  // A value rounds to code k or above when it reaches the linear value of k - 1/2, so its code
  // is the number of such thresholds it reaches: exact rounding without a power for every pixel.
  std::array<double, 255> thresholds{};
  for (std::size_t k = 0; k < thresholds.size(); ++k)
    thresholds[k] = srgb_to_linear((static_cast<double>(k) + 0.5) / 255.0);
  return shown_codes<std::uint8_t>(picture, exposure, transform, instead, [&](double shown) {
    return static_cast<std::uint8_t>(std::ranges::upper_bound(thresholds, shown) -
                                     thresholds.begin());
  });
}

std::vector<std::uint16_t> display_codes_16(const Image& picture, double exposure,
                                            ViewTransform transform,
                                            std::span<const ShownPixel> instead) {
  return shown_codes<std::uint16_t>(picture, exposure, transform, instead, [](double shown) {
    return static_cast<std::uint16_t>(
        std::lround(65535.0 * linear_to_srgb(std::clamp(shown, 0.0, 1.0))));
  });
}

// --- Automatic exposure
//
// All of it works on a histogram of log2 luminance in bins of 1/16 stop,
// whose edges scale with the powers of two and whose counts are integers. A factor of 2^k moves
// every pixel by exactly 16 k bins, and everything below depends only on differences between bins:
// that makes the result exactly covariant, and the same in any order of the pixels.
//
//   content   the pixels of luminance above 0 and within 20 stops of the 99.5th percentile. The black around a scene
//             says nothing about its exposure.
//             Neither does what is a million times darker than the bright parts: a lamp that fills
//             more than 0.5 % of a view lights what is around it far better than that.
//   middle    the mean log2 luminance between the 40th and the 90th percentile of the content. Lamps and windows are
//             seen directly, far above what they light, and deep shadow far below: outside the two
//             percentiles how far does not matter, while a mean over everything would follow them.
//   key       middle -> 0.22, a little above photography's 0.18 because the dark 40 % are left out of the middle.
//   relief    if the 95th percentile would then exceed white, half of the excess is given back, at most one stop.
//             A pool of light in a dim room keeps some of its form,
//             and a window still cannot darken its room for good.
//
// The highest 5 % may clip: those are the lamps.

namespace {

constexpr int bins_per_stop = 16;
constexpr int black_stops = 20;
constexpr double key = 0.22;
constexpr double max_relief = 1.0;

/// Luminances of float pixels span the exponents -150 ... 130.
constexpr int lowest_exponent = -160;
constexpr int highest_exponent = 140;

struct Histogram {
  std::array<std::int64_t, (highest_exponent - lowest_exponent) * bins_per_stop> counts{};
  std::int64_t total = 0;
};

} // namespace

static int luminance_bin(double luminance) {
  int exponent = 0;
  const double mantissa = 2.0 * std::frexp(luminance, &exponent); // in [1, 2)
  const int within =
      std::min(static_cast<int>(bins_per_stop * std::log2(mantissa)), bins_per_stop - 1);
  return (exponent - 1 - lowest_exponent) * bins_per_stop + within;
}

static Histogram luminance_histogram(const Image& picture) {
  Histogram histogram;
  for (const auto& pixel : picture.pixels) {
    const double luminance = 0.2126 * pixel.r + 0.7152 * pixel.g + 0.0722 * pixel.b;
    if (!(luminance > 0.0) || !std::isfinite(luminance))
      continue;
    ++histogram.counts[static_cast<std::size_t>(luminance_bin(luminance))];
    ++histogram.total;
  }
  return histogram;
}

/// The bin below which the share of the pixels lies.
static int percentile_bin(const Histogram& histogram, double share) {
  const auto rank = static_cast<std::int64_t>(share * static_cast<double>(histogram.total - 1));
  std::int64_t below = 0;
  int bin = 0;
  while (below + histogram.counts[static_cast<std::size_t>(bin)] <= rank)
    below += histogram.counts[static_cast<std::size_t>(bin++)];
  return bin;
}

/// Mean distance from `origin`, in bins,
/// of the pixels between two shares of the ranking from dark to bright.
static double trimmed_mean_bin(const Histogram& histogram, int origin, double from, double to) {
  const auto first = static_cast<std::int64_t>(from * static_cast<double>(histogram.total));
  const auto last =
      std::max(first + 1, static_cast<std::int64_t>(to * static_cast<double>(histogram.total)));
  std::int64_t below = 0, sum = 0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const auto upto = below + histogram.counts[bin];
    const auto taken = std::max<std::int64_t>(0, std::min(upto, last) - std::max(below, first));
    sum += taken * (static_cast<std::int64_t>(bin) - origin);
    below = upto;
  }
  return static_cast<double>(sum) / static_cast<double>(last - first);
}

double automatic_exposure(const Image& picture) {
  auto histogram = luminance_histogram(picture);
  if (histogram.total == 0)
    return 0.0;

  // Leave out what is black beside the bright parts.
  const int bright = percentile_bin(histogram, 0.995);
  for (int bin = 0; bin < bright - black_stops * bins_per_stop; ++bin) {
    histogram.total -= histogram.counts[static_cast<std::size_t>(bin)];
    histogram.counts[static_cast<std::size_t>(bin)] = 0;
  }

  // In stops, relative to the lower edge of the bin `bright`;
  // a pixel is on average in the middle of its bin.
  const double half_bin = 0.5 / bins_per_stop;
  const double middle = half_bin + trimmed_mean_bin(histogram, bright, 0.40, 0.90) / bins_per_stop;
  const double highlights =
      half_bin + static_cast<double>(percentile_bin(histogram, 0.95) - bright) / bins_per_stop;
  const double keyed = std::log2(key) - middle;
  const double relief = std::clamp(0.5 * (keyed + highlights), 0.0, max_relief);

  // Rounded before the position of `bright` comes in, which is whole in the same units.
  const double relative = std::round((keyed - relief) * bins_per_stop);
  return (relative - (bright + lowest_exponent * bins_per_stop)) / bins_per_stop;
}

} // namespace meninas
