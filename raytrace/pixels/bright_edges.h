// Edges of what is brighter than a display: what pixels show that are partly of it.
//
//   shown(p) = mean over samples k of T(2^e (S_k + L - mean S))        and not        T(2^e L)
//
// with T the view transform (image/view_transform.h), e the exposure, L the pixel's mean and S_k what sample k
// sees straight: emission, sky and the field's diffuse light, which have no noise. A pixel that is a sixteenth of a
// lamp of a hundred times white is white by its mean: lamps would have edges like stairs. T of each sample is
// what a film or an eye shows of each part of the pixel. Light of mirrors and lobes is in L alone: T of
// each of their rays would take noise for parts of the pixel, and darken highlights. Where all samples see
// the same straight, T(2^e L) is shown.
//
// Limits: edges of lamps in mirrors and gloss, and of bright things so narrow that no pixel's mean reaches white,
// are those of their means; the noise of frosted glass before a lamp is taken for parts of it.
#pragma once

#include "image/display.h"
#include "raytrace/pixels/sample_choice.h"

namespace meninas {

/// 1 for pixels that are white or more at this exposure, beside one that is clearly less bright,
/// and for that one.
PixelMask bright_edges(const Image& picture, double exposure);

/// These pixels of a picture at the exposure and by the transform of `display`. `straight` traces the light that is
/// seen straight, by up to `samples` samples.
std::vector<ShownPixel> shown_at_edges(const Image& picture, const PixelMask& pixels, int samples,
                                       const TraceSamples& straight, const ShownPixels& display);

} // namespace meninas
