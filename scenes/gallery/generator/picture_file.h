// A picture as the bytes of a PNG file, the same on every system:
// indexed colours, stored without compression.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

std::vector<std::uint8_t> png_bytes(const Picture& picture);

} // namespace meninas::gallery
