// A stage as the text of a glTF 2.0 file:
// one line per object, and the same bytes for the same stage.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

/// Positions are rounded to floats;
/// each part's buffer is a data URI, so that a change of a part changes its line alone.
std::string gltf_text(const Stage& stage);

} // namespace meninas::gallery
