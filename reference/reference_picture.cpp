#include "reference/reference_picture.h"

#include "scenes/sampling.h"
#include "scenes/stopwatch.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meninas::reference {

namespace {

/// Mean and sum of squared deviations of the batches so far (Welford 1962).
struct PixelEstimate {
  Rgb mean{0.0};
  Rgb deviations{0.0};
};

/// The number of batches, and their samples, in units of a whole batch.
struct BatchCount {
  int number = 0;
  double whole = 0.0;
};

/// `weight` is what of a whole batch this one has.
void add_batch(PixelEstimate& pixel, const Rgb& batch, double weight, BatchCount batches) {
  const Rgb from_old = batch - pixel.mean;
  pixel.mean += from_old / (batches.whole / weight);
  pixel.deviations += weight * (from_old * (batch - pixel.mean));
}

Rgb variance_of_mean(const PixelEstimate& pixel, BatchCount batches) {
  return pixel.deviations / (batches.whole * (batches.number - 1));
}

/// Samples of the next batch: few at first where time is limited,
/// but for layers, whose shares are compared from batch to batch.
int next_batch(const ReferenceSettings& settings, int samples) {
  const bool is_limited = std::isfinite(settings.max_seconds) && settings.layers == WithLayers::no;
  return is_limited ? std::clamp(samples, 1, batch_samples) : batch_samples;
}

struct Batch {
  int number = 0;
  int samples = batch_samples;
};

/// One batch of one pixel: stratified over its box.
LayerRadiance trace_batch(const TracedScene& traced, const Camera& camera,
                          const ReferenceSettings& settings, int pixel, Batch batch,
                          PathCounts& counts) {
  const std::uint32_t seed = hash(static_cast<std::uint32_t>(pixel),
                                  static_cast<std::uint32_t>(batch.number), settings.seed);
  const double aspect = double(settings.width) / settings.height;
  std::array<CameraRay, packet_size> rays;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const auto u = sobol4(k, seed);
    const double x = pixel % settings.width + double(u[0]);
    const double y = pixel / settings.width + double(u[1]);
    rays[k] = camera_ray(camera, aspect, x / settings.width, y / settings.height,
                         Vec2(concentric_disc(u[2], u[3])));
  }
  const auto count = static_cast<std::size_t>(batch.samples);
  LayerRadiance mean{};
  for (const LayerRadiance& path : trace_paths(traced, rays, seed, settings.search, counts, count))
    for (std::size_t layer = 0; layer < layer_count; ++layer)
      mean[layer] += path[layer] / double(count);
  return mean;
}

/// The layers of the batches so far, by pixel; none where they are not asked for.
struct LayerSums {
  std::vector<LayerRadiance> all;  ///< over the batches
  std::vector<LayerRadiance> last; ///< the latest batch alone
};

void add_batch(LayerSums& sums, std::size_t pixel, const LayerRadiance& batch) {
  sums.last[pixel] = batch;
  for (std::size_t layer = 0; layer < layer_count; ++layer)
    sums.all[pixel][layer] += batch[layer];
}

LayerLuminances mean_luminances(const std::vector<LayerRadiance>& pixels) {
  LayerLuminances means{};
  for (const LayerRadiance& pixel : pixels)
    for (std::size_t layer = 0; layer < layer_count; ++layer)
      means[layer] += glm::dot(Rgb(0.2126, 0.7152, 0.0722), pixel[layer]) / double(pixels.size());
  return means;
}

double relative_error(const std::vector<PixelEstimate>& pixels, BatchCount batches) {
  double variance = 0.0, mean = 0.0;
  for (const PixelEstimate& pixel : pixels) {
    const Rgb v = variance_of_mean(pixel, batches);
    variance += v.r + v.g + v.b;
    mean += pixel.mean.r + pixel.mean.g + pixel.mean.b;
  }
  const double values = 3.0 * double(pixels.size());
  return mean > 0.0 ? std::sqrt(variance / values) / (mean / values) : 0.0;
}

/// The progress of the samples towards a limit; the error falls like the root of their number.
double progress_of(const ReferenceSettings& settings, int samples, double error, double seconds) {
  double fraction =
      std::max(double(samples) / settings.max_samples, seconds / settings.max_seconds);
  if (error > 0.0)
    fraction = std::max(fraction, settings.max_error * settings.max_error / (error * error));
  return std::min(1.0, fraction);
}

std::optional<StoppedBy> reached_limit(const ReferenceSettings& settings, int samples, double error,
                                       double seconds) {
  // Fewer batches say too little about their own variance to end by it.
  constexpr int fewest = 4 * batch_samples;
  if (samples >= settings.max_samples)
    return StoppedBy::samples;
  if (settings.max_error > 0.0 && samples >= fewest && error <= settings.max_error)
    return StoppedBy::error;
  // One more round takes as long, by the sample, as those before have taken in the mean.
  const double round = seconds * next_batch(settings, samples) / samples;
  if (seconds + round > settings.max_seconds)
    return StoppedBy::time;
  return std::nullopt;
}

void fill_images(const std::vector<PixelEstimate>& pixels, BatchCount batches,
                 ReferencePicture& picture) {
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    picture.mean.pixels[k] = glm::vec3(pixels[k].mean);
    picture.variance.pixels[k] = glm::vec3(variance_of_mean(pixels[k], batches));
  }
}

void fill_layers(const LayerSums& sums, int batches, ReferencePicture& picture) {
  picture.mean = Image(picture.mean.width, picture.mean.height);
  for (std::size_t layer = 0; layer < layer_count; ++layer) {
    Image image(picture.mean.width, picture.mean.height);
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
      image.pixels[k] = glm::vec3(sums.all[k][layer] / double(batches));
      picture.mean.pixels[k] += image.pixels[k];
    }
    picture.layers.push_back({layer_name(layer), std::move(image)});
  }
}

PathCounts total_of(const tbb::enumerable_thread_specific<PathCounts>& counts) {
  PathCounts sum;
  for (const PathCounts& own : counts) {
    sum.camera_rays += own.camera_rays;
    sum.path_rays += own.path_rays;
    sum.shadow_rays += own.shadow_rays;
  }
  return sum;
}

} // namespace

ReferencePicture reference_picture(const TracedScene& traced, const Camera& camera,
                                   const ReferenceSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  ReferencePicture picture;
  picture.mean = picture.variance = Image(settings.width, settings.height);
  std::vector<PixelEstimate> pixels(picture.mean.pixels.size());
  const bool layered = settings.layers == WithLayers::yes;
  LayerSums layers;
  layers.all.resize(layered ? pixels.size() : 0);
  layers.last.resize(layers.all.size());
  tbb::enumerable_thread_specific<PathCounts> counts;
  Stopwatch watch;
  double seconds = 0.0;
  BatchCount batches;
  for (;;) {
    const Batch now{++batches.number, next_batch(settings, picture.samples)};
    const double weight = double(now.samples) / batch_samples;
    batches.whole += weight;
    tbb::parallel_for(0, static_cast<int>(pixels.size()), [&](int k) {
      const auto pixel = static_cast<std::size_t>(k);
      const LayerRadiance batch = trace_batch(traced, camera, settings, k, now, counts.local());
      add_batch(pixels[pixel], sum_of(batch), weight, batches);
      if (layered)
        add_batch(layers, pixel, batch);
    });
    if (layered)
      picture.batches.push_back(mean_luminances(layers.last));
    seconds += watch.lap();
    picture.samples += now.samples;
    if (batches.number < 2)
      continue;
    picture.standard_error = relative_error(pixels, batches);
    if (progress)
      progress("paths", progress_of(settings, picture.samples, picture.standard_error, seconds));
    if (const auto limit =
            reached_limit(settings, picture.samples, picture.standard_error, seconds)) {
      picture.stopped_by = *limit;
      fill_images(pixels, batches, picture);
      if (layered)
        fill_layers(layers, batches.number, picture);
      break;
    }
  }
  picture.rays = total_of(counts);
  return picture;
}

} // namespace meninas::reference
