// A channel of errors as a picture people can read:
// magma colours, and a legend with the metric's name and the scale.
#pragma once

#include "image/channel.h"
#include "image/colour_scale.h"
#include "image/image.h"
#include "image/metrics/metrics.h"

#include <string>

namespace meninas {

using HeatMapSettings = ColourScale;

/// Luminance of the picture less that of the reference, in units of radiance:
/// positive where the picture is too bright.
Channel signed_difference(const Image& picture, const Image& reference);

/// The title and scale a map of this metric has by default:
/// "RMSE 0.0123, max 0.8 at 12,34". FLIP always reaches to 1.
HeatMapSettings heat_map_settings(const PictureDifference& difference, Metric metric,
                                  const Channel& errors);

/// The map, each pixel a square so large that the picture
/// is easily seen and the legend below it fits.
/// Linear values for write_png with exposure 0.
Image heat_map(const Channel& errors, const HeatMapSettings& settings);

} // namespace meninas
