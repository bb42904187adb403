// From scene radiance to a displayable picture.
#pragma once

#include "image/image.h"
#include "image/view_transform.h"

#include <cstdint>
#include <vector>

namespace meninas {

/// Exposure in stops (EV): the picture is multiplied by 2^EV. Chosen so that the 'key'
/// of the picture is well exposed and no more than a small share of its pixels clips;
/// robust against a few very bright pixels (lamps) and against black borders. 0 for a black
/// picture. A multiple of 1/16 stop. A picture 2^k times as bright gets exactly k stops less.
double automatic_exposure(const Image& picture);

/// IEC 61966-2-1: linear value to sRGB code value, and back.
/// Both in [0, 1]; clipped outside, NaN becomes 0.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// R, G, B of each pixel times 2^exposure, as the transform shows them, as sRGB code values of 8 or
/// 16 bits, rounded to nearest. No value may be NaN.
std::vector<std::uint8_t> display_codes(const Image& picture, double exposure,
                                        ViewTransform transform = ViewTransform::srgb);
std::vector<std::uint16_t> display_codes_16(const Image& picture, double exposure,
                                            ViewTransform transform = ViewTransform::srgb);

} // namespace meninas
