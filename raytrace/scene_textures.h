// The textures of a scene, decoded, before anything is decided by its materials: those that say the
// same everywhere become factors of the materials that have them.
#pragma once

#include "scenes/materials/texture_lookup.h"

#include <string>
#include <vector>

namespace meninas {

/// Constant ones become factors of the scene's materials (scenes/materials/constant_textures.h).
/// A texture that cannot be decoded changes nothing; a warning names it, and whatever is left out.
DecodedTextures settle_textures(Scene& scene, std::vector<std::string>& warnings);

/// Decodes the picture of the sky that the file brings, if there is one that is not decoded yet.
void settle_sky(Scene& scene, std::vector<std::string>& warnings);

} // namespace meninas
