// The size of an encoded image in pixels, from its header alone: its memory has to be known before it is
// decoded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace meninas {

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

/// The size of a PNG, JPEG, WebP, EXR or HDR, from its header alone; none for other formats and for
/// headers that are cut off.
std::optional<ImageSize> image_size(std::span<const unsigned char> encoded);

} // namespace meninas
