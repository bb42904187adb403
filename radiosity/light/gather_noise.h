// The noise of gathered light as a function of the number of rays.
// The error of N rays spread evenly over the hemisphere (hemisphere_samples.h) falls as N^-p:
// p = 3/4 where they see edges, as in rooms, better where light is smooth (D.
// Mitchell, Consequences of stratified sampling in graphics, SIGGRAPH 1996).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace meninas {

inline constexpr double noise_order = 0.75;

/// The factor on the wanted rays of a vertex where each receiver stands for several elements, by its middle and a
/// share of its corners, so that its noise covers all of them. The squared error is N^-2p, so a given total of
/// rays does most if N grows with the area to the power of 1 / (1 + 2p) = 0.4. The factor is a power of two,
/// because nets are even then.
inline int ray_multiplier(std::size_t elements, std::size_t receivers) {
  constexpr double vertices_of_receiver = 2.0;
  const double elements_of_vertex =
      double(elements) / (vertices_of_receiver * double(std::max<std::size_t>(receivers, 1)));
  const double times = std::pow(std::max(1.0, elements_of_vertex), 1.0 / (1.0 + 2.0 * noise_order));
  return static_cast<int>(std::bit_floor(static_cast<unsigned>(times)));
}

} // namespace meninas
