#include "raytrace/pixels/sample_choice.h"

#include "raytrace/pixels/picture_window.h"
#include "raytrace/pixels/pixel_neighbours.h"

#include <algorithm>
#include <functional>

namespace meninas {

namespace {

constexpr int growth = 4; ///< of the samples of a pixel, from round to round

/// The error bound of pixels.
struct PixelBound {
  float share = 0.0F, mean = 0.0F;

  bool passed_by(const glm::vec3& error, const glm::vec3& radiance) const {
    constexpr float dark = 0.05F; // of the mean: errors in black corners are not seen
    return glm::any(
        glm::greaterThan(error, share * glm::min(radiance + dark * mean, glm::vec3(mean))));
  }
};

PixelBound bound_of(const Image& picture, double pixel_error) {
  double mean = 0.0;
  for (const glm::vec3& pixel : picture.pixels)
    mean += double{pixel.r + pixel.g + pixel.b} / (3.0 * double(picture.pixels.size()));
  return {static_cast<float>(pixel_error), static_cast<float>(mean)};
}

/// The sum of the squares of a pixel and its neighbours.
glm::vec3 squares_around(const Image& image, int x, int y) {
  glm::vec3 sum(0.0F);
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
      sum += image.at(u, v) * image.at(u, v);
  return sum;
}

} // namespace

SampleRange first_samples(const RenderSettings& settings) {
  constexpr int part = growth * growth * growth;
  const int all = std::max(settings.samples, 1);
  return {0, settings.pixel_error > 0.0 ? std::min(all, std::max(settings.min_samples, all / part)) : all};
}

PixelMask uncertain_pixels(const Image& picture, double pixel_error) {
  constexpr float error_of_difference = 0.25F;
  const PixelBound bound = bound_of(picture, pixel_error);
  PixelMask uncertain(picture.pixels.size(), 0);
  for_each_neighbours(picture.width, picture.height, [&](int x, int y, int nx, int ny) {
    const glm::vec3 &a = picture.at(x, y), &b = picture.at(nx, ny);
    if (!bound.passed_by(error_of_difference * glm::abs(a - b), glm::max(a, b)))
      return;
    uncertain[static_cast<std::size_t>(y * picture.width + x)] = 1;
    uncertain[static_cast<std::size_t>(ny * picture.width + nx)] = 1;
  });
  return uncertain;
}

PixelMask uncertain_pixels(const Image& picture, const Image& change, double pixel_error) {
  constexpr float error_of_change = 0.45F;
  const PixelBound bound = bound_of(picture, pixel_error);
  PixelMask uncertain(picture.pixels.size(), 0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      // An edge goes through three of nine pixels:
      // they share the squares. A pixel's own change is believed as well.
      const glm::vec3 error =
          glm::max(glm::abs(change.at(x, y)), glm::sqrt(squares_around(change, x, y) / 3.0F));
      const bool passed = bound.passed_by(error_of_change * error, picture.at(x, y));
      uncertain[static_cast<std::size_t>(y * picture.width + x)] = passed ? 1 : 0;
    }
  return uncertain;
}

std::vector<SampleRound> choose_samples(const RenderSettings& settings, const TraceSamples& trace,
                                        Image& picture) {
  const int all = std::max(settings.samples, 1);
  std::vector<SampleRound> rounds{{first_samples(settings), {}}};
  for (int taken = rounds.back().samples.count; taken < all;) {
    const SampleRound& round = rounds.back();
    Image change(picture.width, picture.height);
    trace(round.share(), [&](int x, int y, const SeenRadiance& seen) {
      const glm::vec3 mean = seen[0] + seen[1] + seen[2];
      glm::vec3& pixel = picture.at(x, y);
      change.at(x, y) = mean - pixel;
      pixel = blended(round.samples, pixel, mean);
    });
    PixelMask next = rounds.size() == 1 ? uncertain_pixels(picture, settings.pixel_error)
                                        : uncertain_pixels(picture, change, settings.pixel_error);
    // Only pixels with all samples so far can take the next ones.
    if (!round.pixels.empty())
      std::ranges::transform(next, round.pixels, next.begin(), std::bit_and<std::uint8_t>{});
    const int until = std::min(all, growth * taken);
    rounds.push_back({{taken, until - taken}, std::move(next)});
    taken = until;
  }
  return rounds;
}

void trace_round(const RenderSettings& settings, const SampleRound& round, const TraceSamples& trace,
                 const StorePixel& store) {
  SampleShare share = round.share();
  if (!settings.window)
    return trace(share, store);
  share.window = &*settings.window;
  trace(share, store);
  if (!settings.display)
    return;
  const PixelMask around =
      pixels_around(*settings.window, settings.width, settings.height, round.pixels);
  const PictureWindow tiles = with_tiles_around(*settings.window, settings.width, settings.height);
  trace({round.samples, &around, &tiles}, store);
}

SampleCounts counts_of(const std::vector<SampleRound>& rounds, std::size_t pixels) {
  SampleCounts counts(pixels, 0);
  for (const SampleRound& round : rounds)
    for (std::size_t p = 0; p < pixels; ++p)
      if (round.pixels.empty() || round.pixels[p] != 0)
        counts[p] = static_cast<std::uint32_t>(round.samples.first + round.samples.count);
  return counts;
}

} // namespace meninas
