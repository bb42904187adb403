// Structural similarity of two displayed pictures.
//
// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error
// visibility to structural similarity", IEEE Trans. Image Processing 13(4), 2004, eq. 13:
//   SSIM = (2 mu_a mu_b + C1) (2 sigma_ab + C2) / ((mu_a^2 + mu_b^2 + C1)
//   (sigma_a^2 + sigma_b^2 + C2))
// with means, variances and covariance under an 11 x 11 Gaussian window of 1.5 pixels deviation,
// C1 = 0.01^2, C2 = 0.03^2.
// The grey values are sRGB-encoded Rec.709 luminance in [0, 1].
#pragma once

#include "image/channel.h"
#include "image/image.h"

namespace meninas {

/// 1 where both pictures are the same. Values are linear; clipped to [0, 1].
Channel ssim_map(const Image& a, const Image& b);

/// The mean over all pixels whose window lies inside the picture, as in the paper;
/// over all pixels where none does.
double mean_ssim(const Channel& map);

} // namespace meninas
