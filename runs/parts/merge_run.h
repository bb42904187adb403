// `merge`: the parts of a picture put together, to the files that one `render` writes, to the bit.
//
// The exposure of a PNG is that of the whole picture (image/display.h, stops) unless the parts were
// given one. Edges of what is brighter than the display are those that the parts know at this exposure.
#pragma once

#include "runs/outputs.h"

#include <filesystem>
#include <vector>

namespace meninas {

struct MergeRequest {
  std::vector<std::filesystem::path> tiles;    ///< in any order
  std::vector<std::filesystem::path> pictures; ///< .exr, .png or .hdr
  PixelType exr_type = PixelType::half;        ///< of a picture without layers
  int png_bits = 8;
};

/// Throws InputError that names the part where parts do not fit together, one is missing or
/// given twice; OutputError where a picture cannot be written.
void merge_run(const MergeRequest& request, const RunEvents& events = {});

} // namespace meninas
