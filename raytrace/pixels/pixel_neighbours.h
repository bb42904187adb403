// Neighbouring pixels of a picture, straight and across: of eight neighbours those four that make
// every pair once, as differences between pixels are looked for pair by pair.
#pragma once

#include <utility>

namespace meninas {

/// visit(x, y, nx, ny) for each pair of neighbours once:
/// to the right of (x, y) and the three below it, row by row.
template <typename Visit>
void for_each_neighbours(int width, int height, const Visit& visit) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}})
        if (x + dx >= 0 && x + dx < width && y + dy < height)
          visit(x, y, x + dx, y + dy);
}

} // namespace meninas
