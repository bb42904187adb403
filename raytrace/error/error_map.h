// Where a picture is how far off:
// an estimate of the error of every pixel and channel, in units of radiance.
//
//   e(p)^2 = |error of direct light,
//   there|^2 + |noise of camera rays, there|^2 + (share L(p))^2
//
// The first is what interpolation makes of the edges of light, by two independent computations at
// every pixel (picture_error.h), the second what another draw of all camera rays changes;
// both are means over the pixels around. The third is the error of gathered light,
// which is known as a part of the radiance only, all over the picture.
#pragma once

#include "raytrace/error/picture_error.h"

namespace meninas {

/// Takes about as long as three pictures. `settings` and `error` are those of `picture`.
Image error_map(const IrradianceField& field, const Camera& camera,
                const TwoPassSettings& settings, const Image& picture, const PictureError& error);

} // namespace meninas
