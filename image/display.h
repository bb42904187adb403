// From scene radiance to a displayable picture.
#pragma once

#include "image/image.h"
#include "image/view_transform.h"

#include <cstddef>
#include <cstdint>
#include <span>
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

/// The shown value of a pixel, linear in [0, 1], where it is not the transform of its mean.
struct ShownPixel {
  std::size_t pixel; ///< row by row
  glm::vec3 shown;
};

/// The shown values of pixels at one exposure, by one transform.
struct ShownPixels {
  double exposure = 0.0; ///< stops
  ViewTransform transform = ViewTransform::srgb;
  std::vector<ShownPixel> pixels;
};

/// R, G, B of each pixel times 2^exposure, as the transform shows them, as sRGB code values of 8 or
/// 16 bits, rounded to nearest: of `instead` where that has the pixel. No value may be NaN.
std::vector<std::uint8_t> display_codes(const Image& picture, double exposure,
                                        ViewTransform transform = ViewTransform::srgb,
                                        std::span<const ShownPixel> instead = {});
std::vector<std::uint16_t> display_codes_16(const Image& picture, double exposure,
                                            ViewTransform transform = ViewTransform::srgb,
                                            std::span<const ShownPixel> instead = {});

} // namespace meninas
