#include "raytrace/pixels/picture_window.h"

#include "scenes/types.h"

#include <algorithm>
#include <cstdint>

namespace meninas {

/// In tiles.
static PictureWindow tiles_of_part(PictureWindow all, int number, int count) {
  while (count > 1) {
    const bool across = all.width >= all.height;
    int& length = across ? all.width : all.height;
    const int other = across ? all.height : all.width;
    const int half = count / 2;
    const auto even = (std::int64_t{length} * half + half) / count;
    const int cut = std::clamp(static_cast<int>(even), 1, length - 1);
    // Each side has a tile for each of its parts.
    const int left = std::clamp(half, std::max(1, count - (length - cut) * other),
                                std::min(count - 1, cut * other));
    if (number < left) {
      length = cut;
      count = left;
    } else {
      (across ? all.x : all.y) += cut;
      length -= cut;
      number -= left;
      count -= left;
    }
  }
  return all;
}

static int tiles_along(int pixels) { return (pixels + tile_size - 1) / tile_size; }

int max_parts(int width, int height) { return tiles_along(width) * tiles_along(height); }

/// The pixels from one place to another, as far as the picture goes.
static PictureWindow clipped(int x0, int y0, int x1, int y1, int width, int height) {
  x0 = std::max(x0, 0);
  y0 = std::max(y0, 0);
  return {x0, y0, std::min(x1, width) - x0, std::min(y1, height) - y0};
}

PictureWindow window_of_part(int width, int height, int number, int count) {
  expects(number >= 0 && number < count && count <= max_parts(width, height),
          "a part of a picture has a tile");
  const PictureWindow tiles =
      tiles_of_part({0, 0, tiles_along(width), tiles_along(height)}, number, count);
  return clipped(tile_size * tiles.x, tile_size * tiles.y, tile_size * (tiles.x + tiles.width),
                 tile_size * (tiles.y + tiles.height), width, height);
}

static PictureWindow grown(const PictureWindow& window, int by, int width, int height) {
  return clipped(window.x - by, window.y - by, window.x + window.width + by,
                 window.y + window.height + by, width, height);
}

PictureWindow with_tiles_around(const PictureWindow& window, int width, int height) {
  return grown(window, tile_size, width, height);
}

static bool has(const PictureWindow& window, int x, int y) {
  return x >= window.x && x < window.x + window.width && y >= window.y &&
         y < window.y + window.height;
}

PixelMask pixels_around(const PictureWindow& window, int width, int height,
                        const PixelMask& chosen) {
  PixelMask around(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const PictureWindow near = grown(window, 1, width, height);
  for (int y = near.y; y < near.y + near.height; ++y)
    for (int x = near.x; x < near.x + near.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      around[pixel] = !has(window, x, y) && (chosen.empty() || chosen[pixel] != 0) ? 1 : 0;
    }
  return around;
}

PixelMask within(const PictureWindow& window, int width, PixelMask pixels) {
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
    if (!has(window, static_cast<int>(pixel % static_cast<std::size_t>(width)),
             static_cast<int>(pixel / static_cast<std::size_t>(width))))
      pixels[pixel] = 0;
  return pixels;
}

} // namespace meninas
