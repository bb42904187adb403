// The reference: what is true, as far as samples tell.
// A picture by path tracing (trace_paths.h) with the variance of every pixel.
//
// Samples come in batches of sixteen per pixel,
// stratified within a batch and independent between batches. With m batches of means x_b,
//   mean = sum x_b / m,   variance of the mean = sum (x_b - mean)^2 / (m (m - 1)),
// so that stratification lowers the noise without spoiling its estimate. Where time is limited the
// first batches have 1, 1, 2, 4 and 8 samples, so that there is a picture soon; with n_b samples of
// N in all, mean = sum n_b x_b / N and variance = sum n_b (x_b - mean)^2 / (N (m - 1)).
// The pixel is a box, as in pass two.
//
// Conventions of the two passes hold (sides, backs, ideal mirrors, what counts as diffuse),
// and what these do not model yet is there: rough metals, dielectric coats, panes, textures,
// cut-outs, punctual lights. Light of a punctual light is found over chains of at most two mirrors.
#pragma once

#include "image/image.h"
#include "reference/trace_paths.h"
#include "scenes/progress.h"

#include <limits>

namespace meninas::reference {

inline constexpr int batch_samples = static_cast<int>(packet_size);

struct ReferenceSettings {
  int width = 512;
  int height = 512;
  /// It stops at whichever of the three comes first, after at least two batches.
  int max_samples = 1 << 24; ///< per pixel, in whole batches
  double max_error = 0.01;   ///< standard error of the picture, relative; 0 for none
  double max_seconds = std::numeric_limits<double>::infinity();
  std::uint32_t seed = 0;
  LightSearch search = LightSearch::both;
  WithLayers layers = WithLayers::no;
};

enum class StoppedBy { samples, error, time };

struct ReferencePicture {
  Image mean;     ///< radiance; with layers exactly their sum, in their order
  Image variance; ///< of the mean, by pixel and channel
  int samples = 0;
  double standard_error =
      0.0; ///< root mean square of the pixels' standard errors over the mean radiance; 0 for a black picture
  StoppedBy stopped_by = StoppedBy::samples;
  PathCounts rays;
  std::vector<Layer> layers;            ///< of light_layers.h, if asked for
  std::vector<LayerLuminances> batches; ///< each batch's picture alone, for shares and their errors
};

/// The same bits for any number of threads;
/// a limit of time alone decides about the number of samples by the clock.
ReferencePicture reference_picture(const TracedScene& traced, const Camera& camera,
                                   const ReferenceSettings& settings,
                                   const Progress& progress = {});

} // namespace meninas::reference
