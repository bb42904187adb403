// Short texts drawn into pictures:
// capitals, digits and a few signs, five pixels wide and seven high.
#pragma once

#include "image/image.h"

#include <string_view>

namespace meninas {

inline constexpr int letter_width = 5, letter_height = 7, letter_advance = 6;

/// Pixels from the left edge of the first letter to the right edge of the last.
int text_width(std::string_view text, int scale);

/// Draws with (x, y) as the upper left corner, every dot scale x scale pixels; what lies
/// outside is cut off. Small letters become capitals; a sign the alphabet lacks is a blank.
void draw_text(Image& picture, int x, int y, std::string_view text, int scale,
               const glm::vec3& colour);

} // namespace meninas
