// Does a picture agree with a noisy reference? Every value
// against the standard error of the reference there.
//
//   z = (picture - mean) / sqrt(variance + rounding^2)
// with the variance of the mean by pixel and channel. Where the picture has no error of its own,
// z is normally distributed with deviation 1, so one value in 400 exceeds 3.02 (two-sided).
// That quantile is the test's figure: single pixels whose variance was not found by the reference's
// samples do not decide it, and a bias of one standard error everywhere raises it to 3.8.
#pragma once

#include "image/image.h"

namespace meninas {

/// The share of values that may be larger than the figure.
inline constexpr double z_outliers = 1.0 / 400.0;

/// The (1 - z_outliers) quantile of |z| over all pixels and channels.
/// Rounding is that of half floats: 2^-11 of the value and of the mean of the picture,
/// so that pixels without variance (a lamp seen directly) must agree to that accuracy.
double z_figure(const Image& picture, const Image& mean, const Image& variance);

} // namespace meninas
