// The pixels of a texture, decoded.
#pragma once

#include "scenes/types.h"

#include <vector>

namespace meninas {

/// Colours are stored as sRGB and wanted linear; metalness and roughness are numbers as they are.
enum class TextureContent { colour, numbers };

/// Rows from the top; red, green, blue and alpha.
struct TexturePixels {
  int width = 0, height = 0;
  std::vector<glm::vec4> texels;
  bool stands_in = false; ///< white, for what could not be decoded
  std::vector<TexturePixels> coarser = {}; ///< the pyramid's further levels (texture_pyramid.h)
};

} // namespace meninas
