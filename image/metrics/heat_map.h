// A channel of errors as a picture people can read:
// magma colours, and a legend with the metric's name and the scale.
#pragma once

#include "image/channel.h"
#include "image/image.h"
#include "image/metrics/metrics.h"

#include <string>

namespace meninas {

enum class ErrorScale {
  magnitude, ///< 0 .. top, in magma
  signed_    ///< -top .. top, blue below zero and orange above
};

struct HeatMapSettings {
  std::string title; ///< drawn above the scale
  double top = 1.0;  ///< the value of the brightest colour, positive; larger ones look the same
  ErrorScale scale = ErrorScale::magnitude;
};

/// Luminance of the picture less that of the reference, in units of radiance:
/// positive where the picture is too bright.
Channel signed_difference(const Image& picture, const Image& reference);

/// A scale that ends in 1, 2 or 5 times a power of ten and shows at least 99.5 % of the values,
/// whatever their sign; 1 if all are 0.
double readable_top(const Channel& errors);

/// The title and scale a map of this metric has by default:
/// "RMSE 0.0123, max 0.8 at 12,34". FLIP always reaches to 1.
HeatMapSettings heat_map_settings(const PictureDifference& difference, Metric metric,
                                  const Channel& errors);

/// The map, each pixel a square so large that the picture
/// is easily seen and the legend below it fits.
/// Linear values for write_png with exposure 0.
Image heat_map(const Channel& errors, const HeatMapSettings& settings);

} // namespace meninas
