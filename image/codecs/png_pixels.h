// What libpng may see of a PNG:
// only the chunks that carry its pixels, after a check that all of them are there.
//
// libpng reports what is wrong with a file on stderr, and so does it with harmless oddities
// of colour profiles. Reading the chunks first gives a reason that can be handed on,
// and leaves out gamma and profiles, which glTF tells its readers to ignore.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace meninas::decoder {

/// The PNG with its chunks IHDR, PLTE, tRNS, IDAT and IEND alone.
/// Throws std::runtime_error when one is cut off, damaged (by its checksum) or missing.
/// Leaves out chunks that come twice, too late, or have no meaning for this kind of pixels.
std::vector<std::uint8_t> png_pixel_chunks(std::string_view png);

} // namespace meninas::decoder
