// Rays that mirrors keep among themselves, made fewer without loss of light.
//
// In a closed space of mirrors, as between a mirror and a sheet that lies on it, no ray ever lands: all go on
// until their throughput or their bounces end them, thousands of legs each. So of the n_1 rays of a receiver
// that mirrors send on, after k > 64 bounces there may be
//
//   n_k = 64 n_1 / k.
//
// Where there are more, of every two neighbours a and b one goes on for both (the comb of Booth 1996):
//
//   a with the chance w_a / (w_a + w_b), else b;   its weight is w_a + w_b, its throughput tau its own.
//
// The sum of the weights stays as it was, and so does that of w tau in the mean. A receiver has 64 n_1 (1 + ln(k / 64)) + k legs
// at most: the last ray of all goes on. Between two facing mirrors 1 / k^2 of the rays are still under way,
// far fewer than n_k: there, nothing changes.
#pragma once

#include "radiosity/transport/gathered_rays.h"

namespace meninas {

/// The state of the rays of one receiver.
struct Bounces {
  std::size_t done = 0;    ///< k, by each of the rays
  std::size_t sent_on = 0; ///< n_1
};

/// The most rays that go on after so many bounces, n_k; without limit up to 64.
std::size_t max_rays(const Bounces& bounces);

/// Where there are more than max_rays(), half of them stay, in their order. The seed is that of the receiver.
void comb_rays(std::vector<MirroredRay>& rays, const Bounces& bounces, std::uint32_t seed);

} // namespace meninas
