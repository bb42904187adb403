// What must hold of light, and what is thrown where it does not.
#pragma once

#include <fmt/format.h>
#include <glm/gtx/component_wise.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace meninas::test {

/// Something that must not be.
struct Finding : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const std::string& what) {
  if (!holds)
    throw Finding(what);
}

template <typename Colour>
bool is_light(const Colour& c, double least = 0.0) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) && c.r >= least &&
         c.g >= least && c.b >= least;
}

/// Differences of sums of floats may be less than nothing by their rounding, a few 1e-7 of the
/// largest.
template <typename Colour>
void require_light(const std::vector<Colour>& values, const char* what) {
  double largest = 0.0;
  for (const Colour& value : values)
    largest = std::max(largest, double{glm::compMax(value)});
  for (std::size_t k = 0; k < values.size(); ++k)
    require(is_light(values[k], -1e-6 * largest),
            fmt::format("{} {} of {} is {} {} {}, the largest {}", what, k, values.size(),
                        values[k].r, values[k].g, values[k].b, largest));
}

} // namespace meninas::test
