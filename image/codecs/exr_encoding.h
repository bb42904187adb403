// Pictures as OpenEXR files, by the format's own library:
// what writes needs none of the 260 shared objects that OpenImageIO brings.
#pragma once

#include "image/image.h"
#include "image/picture_options.h"

#include <cstddef>
#include <span>
#include <vector>

namespace meninas {

/// The file that `write_exr` writes, of what `write_exr` accepts.
/// The same picture gives the same bytes, by any number of threads.
/// Rows are compressed by as many threads as oneTBB may use.
/// Throws std::exception where the library cannot go on.
std::vector<std::byte> encode_exr(const Image& picture, std::span<const Layer> layers,
                                  PixelType type, const Attributes& attributes);

/// The file that `write_exr_window` writes: floats, all layers of R, G and B.
std::vector<std::byte> encode_exr_window(const Image& picture, std::span<const Layer> layers,
                                         const DataWindow& window, const Attributes& attributes);

} // namespace meninas
