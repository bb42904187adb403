// Visibility statistics of each emitter image from the shadow rays of a mean (shared_light.h).
//
// V is the share of an image that is seen past known blockers. One ray finds V = 0 or 1, and of an uneven
// sky what it shows; its variance is V (1 - V), or that of what rays have shown.
#pragma once

#include "radiosity/light/light_samples.h"
#include "radiosity/light/occluder_cache.h"

#include <vector>

namespace meninas {

/// The occluders before one emitter in one world.
struct ImageOccluders {
  std::vector<CachedOccluder> known;
  std::vector<CachedOccluder> met; ///< by the mean in hand
  std::size_t learned = 0;       ///< so far, forgotten ones too
  std::uint32_t rims = 0;        ///< points that have looked at the rim since something was learned

  /// Things as finely divided as this are left to rays.
  bool too_many() const { return learned > 32; }
};

/// One emitter in one world, over all points so far.
struct ImageSum {
  Rgb source{0.0}; ///< tau E
  WorldId world = real_world;
  std::uint32_t emitter = 0;
  double form_factor = 0.0;          ///< sum over points, past known blockers
  double all = 0.0, seen = 0.0;      ///< weights of its shadow rays, and of those that arrive
  Rgb left{0.0};                     ///< of the latter, what glass on their way leaves, and of the sky what they show
  double squares = 0.0;              ///< the same, the square of its brightest channel
  std::uint32_t rays = 0;            ///< shadow rays so far
  std::uint32_t from_a_point = 1;    ///< from each of the next points
  ImageOccluders* blockers = nullptr; ///< null where none are learned
};

/// The irradiance from an image at the point without blockers, its brightest channel, W/m^2.
double brought_by(const ImageSum& image, double form_factor);

/// The variance of what a ray finds of an image, dimensionless.
double variance_of(const Lighting& light, const ImageSum& image);

/// Whether rays have found different things of an image.
bool shows_differences(const Lighting& light, const ImageSum& image);

/// Later means know what rays have met: returns whether that is more than before.
/// Where it is ever more, as it is of finely divided things, rays alone are better.
bool cache_occluders(std::vector<ImageSum>& images);

} // namespace meninas
