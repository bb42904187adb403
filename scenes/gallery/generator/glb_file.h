// A stage as the bytes of a binary glTF 2.0 file (GLB, version 2): for scenes too large for text.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

/// One buffer holds all that gltf_text.h spreads over many; images are views of it.
std::string glb_bytes(const Stage& stage);

} // namespace meninas::gallery
