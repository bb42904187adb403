// From the scene to what the path tracer reads: rays, textures, lights, and their images in mirrors.
#pragma once

#include "reference/traced_scene.h"

namespace meninas::reference {

/// Throws InputError for a texture that cannot be decoded.
TracedScene make_traced_scene(Scene scene);

} // namespace meninas::reference
