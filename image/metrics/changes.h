// The difference between two pictures in words: where most of it is, and whether it is brighter or darker there.
#pragma once

#include "image/image.h"

#include <string>

namespace meninas {

/// "most at x 36-47, y 60-71: 12 % brighter; whole picture 1 % brighter;
/// worst pixel (40, 66): (0.1, 0.2, 0.3), was (0.1, 0.2, 0.2) W/m^2/sr", of that unit.
/// The region is the one of 8 x 8 equal parts with the largest sum of squares;
/// brightness is mean luminance.
std::string describe_change(const Image& picture, const Image& reference, const std::string& unit);

} // namespace meninas
