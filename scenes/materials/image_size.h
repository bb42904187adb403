// How many pixels an encoded image has, from its header alone:
// what it will take in memory has to be known before it is decoded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace meninas {

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

/// Of PNG, JPEG, WebP, EXR and HDR; none for other formats and for headers that are cut off.
/// Nothing else of the image is looked at.
std::optional<ImageSize> image_size(std::span<const unsigned char> encoded);

} // namespace meninas
