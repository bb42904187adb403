// The relative error of a picture against a reference:
// the root of the mean square of the difference over the mean of the reference,
//
//   e^2 = sum over pixels and channels of ((a - b)^2 - v)  /  (sum of b)^2  *  number of either
//
// with v the variance of the reference where that is known, so that its noise does not count.
// Pixels that are marked, such as those of emitters, are left out.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <span>

namespace meninas {

/// `left_out` by pixel, or empty: none is. `variance` of the size of the reference, or null.
/// All of one size. 0 where the difference is less than the noise, or the reference black.
double relative_error(const Image& picture, const Image& reference,
                      std::span<const std::uint8_t> left_out, const Image* variance = nullptr);

} // namespace meninas
