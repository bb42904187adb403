// How gathered light gets less noisy with more rays.
// Of N that are spread evenly over the hemisphere (receiver_rays.h) the error falls as N^-p:
// p = 3/4 where what they see has edges, as in rooms, better where it is smooth (D.
// Mitchell, Consequences of stratified sampling in graphics, SIGGRAPH 1996).
#pragma once

namespace meninas {

inline constexpr double noise_order = 0.75;

/// Where noise has a bound, a sample takes at the most so many times the rays that are asked for.
inline constexpr int most_times_asked = 16;

} // namespace meninas
