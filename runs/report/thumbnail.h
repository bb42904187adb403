// Small versions of pictures.
#pragma once

#include "image/image.h"

namespace meninas {

/// No side longer than `longest_side` pixels, each the mean of the pixels it covers,
/// weighted by the part covered; a picture that is small enough stays as it is.
Image thumbnail(const Image& picture, int longest_side);

} // namespace meninas
