// Adaptive pixel sampling:
// which pixels take how many samples (in rounds, after Kirk and Arvo 1991).
//
// Every pixel takes its first samples, `min_samples` or more; every further round makes them four times
// as many, up to `samples` in at most four rounds, in the pixels that still look to be off by more
// than `pixel_error` of their radiance or of the picture's mean radiance, whichever is less:
//
//   e > pixel_error min(L + 0.05 mean, mean),       in some channel
//
// After the first round e is a quarter of the largest difference from a neighbour:
// the mean of four samples is off by about 0.14 times the step at an edge,
// and by 0.4 times what neighbours differ by where all is noise. After a later round,
// from n / 4 to n samples, e is by what the round has changed the pixel and those around it:
// that is the error of the n / 4 (times sqrt(4/3)), of which n have a half where all is noise,
// a third at edges. The choice is made of whole pictures, so that it depends on no tile
// and no thread, and of the whole light, so that all layers are of the same samples.
// Limit: a feature that the first samples of a pixel and its neighbours all miss is not found.
#pragma once

#include "raytrace/tiles.h"

#include <functional>

namespace meninas {

/// Samples that every pixel takes: all where sampling is not adaptive.
SampleRange first_samples(const RenderSettings& settings);

struct SampleRound {
  SampleRange samples;
  PixelMask pixels; ///< that take them; empty: all

  SampleShare share() const { return {samples, pixels.empty() ? nullptr : &pixels}; }
};

using TraceSamples = std::function<void(const SampleShare&, const StorePixel&)>;

/// The rounds of a picture. All but the last are traced to decide, and blended into `picture`;
/// the last one may have no pixels.
std::vector<SampleRound> choose_samples(const RenderSettings& settings, const TraceSamples& trace,
                                        Image& picture);

/// Traces a round: of a window its pixels, and those around it where edges are asked for, which are between
/// pixels of either side.
void trace_round(const RenderSettings& settings, const SampleRound& round, const TraceSamples& trace,
                 const StorePixel& store);

/// By pixel, of all rounds.
SampleCounts counts_of(const std::vector<SampleRound>& rounds, std::size_t pixels);

/// The mean of a pixel that has had all samples before the round's, with the mean of the round's.
inline glm::vec3 blended(const SampleRange& round, const glm::vec3& before, const glm::vec3& mean) {
  return before + static_cast<float>(round.count) / static_cast<float>(round.first + round.count) *
                      (mean - before);
}

/// 1 where pixels look to be off by more than `pixel_error` after the first round,
/// by what neighbours differ by.
PixelMask uncertain_pixels(const Image& picture, double pixel_error);

/// The same after a later round that has changed pixels by `change`.
PixelMask uncertain_pixels(const Image& picture, const Image& change, double pixel_error);

} // namespace meninas
