// The pyramid of an image (Williams 1983):
// each level half as wide and high as the one before, rounded down, the last a single texel.
//
// A texel of a level is the mean of the one before over the area it covers,
// texels counted by the share of them that is covered. So every level has the mean of the image,
// whatever its size; a filter that weighs whole texels, as resampling libraries do, has not.
#pragma once

#include "scenes/materials/texture_pixels.h"

#include <functional>

namespace meninas {

/// The levels after `image`; none for an image of one texel.
std::vector<TexturePixels> coarser_levels(const TexturePixels& image);

/// The levels after an image of `width` by `height` texels that are worked out, `at(x, y)`, from several threads.
std::vector<TexturePixels> coarser_levels(int width, int height,
                                          const std::function<glm::vec4(int x, int y)>& at);

} // namespace meninas
