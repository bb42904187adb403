// A window of the picture: what one machine renders of a picture that many share.
//
// Pixels are traced by tiles of 32 x 32, and what their rays share (coherent_beams.h) depends on the tile. So
// windows are whole tiles: a pixel has the same bits in whatever window it is. The picture of so many tiles is
// halved across its longer side, in proportion to the parts on either side, until every part is one window
// (a k-d tree, Bentley 1975); numbers of parts are without unit, places in pixels.
#pragma once

#include "raytrace/pixels/render_context.h"

namespace meninas {

inline constexpr int tile_size = 32; ///< pixels square

/// As many as it has tiles.
int max_parts(int width, int height);

/// Part `number` of `count`, from 0. All of them cover each pixel once. Precondition: count <= max_parts.
PictureWindow window_of_part(int width, int height, int number, int count);

/// Bigger by a tile on every side, as far as the picture goes.
PictureWindow with_tiles_around(const PictureWindow& window, int width, int height);

/// 1 for the pixels that touch the window from outside, of those chosen (empty: all).
PixelMask pixels_around(const PictureWindow& window, int width, int height,
                        const PixelMask& chosen);

/// 0 for the pixels outside.
PixelMask within(const PictureWindow& window, int width, PixelMask pixels);

} // namespace meninas
