// Where x in [0, 1] falls in a table of values at even steps: between entries `first` and `first` + 1, at `place`
// of the way from one to the next; values there are interpolated linearly.
#pragma once

#include <algorithm>
#include <cstddef>

namespace meninas {

struct TableCell {
  std::size_t first;
  double place; ///< in [0, 1]
};

inline TableCell table_cell(double x, int steps) {
  const double scaled = std::clamp(x, 0.0, 1.0) * steps;
  const int first = std::min(static_cast<int>(scaled), steps - 1);
  return {static_cast<std::size_t>(first), scaled - first};
}

} // namespace meninas
