// From scene radiance to a displayable picture.
#pragma once

#include "image/image.h"

namespace meninas {

/// Exposure in stops (EV): the picture is multiplied by 2^EV. Chosen so that the 'key' of the picture is well exposed and
/// no more than a small share of its pixels clips; robust against a few very bright pixels (lamps) and against black borders. 0 for a black picture.
double automatic_exposure(const Image& picture);

/// IEC 61966-2-1: linear value to sRGB code value, and back. Both in [0, 1]; clipped outside.
float srgb_encode(float linear);
float srgb_decode(float encoded);

} // namespace meninas
