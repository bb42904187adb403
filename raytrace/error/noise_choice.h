// The pixels that are drawn again to estimate the noise of camera rays.
//
// Noise sits at edges: the rim of a bright spot, a hundredth of the pixels or less,
// may hold nearly all of it. So of N pixels those that differ from
// their neighbours are drawn rather, each at most once, with the chance
//
//   pi(p) = min(1, s (1/N + C^2(p) / sum C^2) / 2),       sum pi = n
//
// where C^2 is the squared contrast and s makes the chances those of n pixels.
// A sum over all of them is that of value / pi over those drawn,
// whatever C is (Horvitz and Thompson 1952): pixels drawn for certain count as what they are,
// and none counts for more than twice what it did if all were drawn alike.
#pragma once

#include "raytrace/error/probe_choice.h"

namespace meninas {

/// By pixel, row by row: the sum over channels and the eight neighbours of the squared difference,
/// 0 at and from emitters.
std::vector<double> squared_contrasts(const Image& picture, std::span<const std::uint8_t> emits);

/// pi, of values C^2 >= 0; all 1 where so many are wanted.
std::vector<double> chances_by(std::span<const double> contrasts, std::size_t wanted);

/// Indices in rising order, each with its chance, as many as the chances sum to (rounded):
/// of neighbours in the list one or the other is drawn, so that any run of the list has as many
/// as its chances sum to, to less than one (the ordered pivotal method: Deville and Tillé 1998).
std::vector<std::size_t> drawn_by(std::span<const double> chances, std::uint32_t seed);

/// Returns `wanted` pixels with weights such that the weighted mean over them is an unbiased estimate
/// of the mean over all. `contrasts` is by pixel of the whole picture.
ProbeChoice choose_redrawn(std::span<const glm::ivec2> pixels, std::span<const double> contrasts,
                           int width, std::size_t wanted, std::uint32_t seed);

} // namespace meninas
