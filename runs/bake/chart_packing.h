// Rectangles of whole texels packed into a picture, none over another.
//
// By the skyline bottom-left heuristic (Jylanki 2010, A Thousand Ways to Pack the Bin) of stb_rect_pack.
#pragma once

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace meninas {

/// Where the first texel of each rectangle is, in a picture of that many texels, or none where they do
/// not fit. The same rectangles give the same places.
std::optional<std::vector<glm::ivec2>> pack_rectangles(const std::vector<glm::ivec2>& sizes,
                                                       glm::ivec2 picture);

} // namespace meninas
