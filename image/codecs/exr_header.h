// Checks of an EXR's header against the size of the file, before OpenEXR relies on it.
//
// OpenEXR allocates room for every attribute,
// for the table of chunks and for buffers of rows as the header says, before it reads any of them:
// a damaged header of a few bytes would otherwise ask for gigabytes.
#pragma once

#include "image/codecs/decoder_seam.h"

#include <string_view>

namespace meninas::decoder {

/// Throws std::runtime_error when an attribute or the table of chunks cannot fit into the file,
/// or a side exceeds the limit.
void check_exr_header(std::string_view exr, const Limits& limits);

} // namespace meninas::decoder
