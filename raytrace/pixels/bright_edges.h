// Edges of what is brighter than a display: what pixels show that are partly of it.
//
//   shown(p) = mean over samples k of T(2^e L_k)        and not        T(2^e mean L_k)
//
// with T the view transform (image/view_transform.h) and e the exposure. A pixel that is a sixteenth of a
// lamp of a hundred times white is white by its mean: lamps would have edges like stairs. T of each sample is
// what a film or an eye shows of each part of the pixel. Where nothing is near white T is linear,
// or nearly so, and both are the same.
//
// Limits: bright things so narrow that no pixel's mean reaches white keep their mean.
#pragma once

#include "image/display.h"
#include "raytrace/pixels/sample_choice.h"

namespace meninas {

/// 1 for pixels that are white or more at this exposure, beside one that is clearly less bright,
/// and for that one.
PixelMask bright_edges(const Image& picture, double exposure);

/// What these pixels show by all samples of the settings, at the exposure and by the transform of
/// `display`.
std::vector<ShownPixel> shown_at_edges(const RenderSettings& settings, const TraceSamples& trace,
                                       const PixelMask& pixels, const ShownPixels& display);

} // namespace meninas
