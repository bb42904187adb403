#include "raytrace/sample_choice.h"

#include <algorithm>
#include <functional>

namespace meninas {

namespace {

constexpr int growth = 4; ///< of the samples of a pixel, from round to round

/// How far off pixels may be.
class PixelBounds {
public:
  PixelBounds(const Image& picture, double pixel_error) : picture_(picture) {
    double mean = 0.0;
    for (const glm::vec3& pixel : picture.pixels)
      mean += double{pixel.r + pixel.g + pixel.b} / (3.0 * double(picture.pixels.size()));
    constexpr double dark = 0.05; // of the mean: errors in black corners are not seen
    share_ = static_cast<float>(pixel_error);
    floor_ = static_cast<float>(dark * mean);
    mean_ = static_cast<float>(mean);
  }

  bool passed_by(const glm::vec3& error, const glm::vec3& radiance) const {
    return glm::any(
        glm::greaterThan(error, share_ * glm::min(radiance + floor_, glm::vec3(mean_))));
  }

  bool passed_by(const glm::vec3& error, std::size_t pixel) const {
    return passed_by(error, picture_.pixels[pixel]);
  }

private:
  const Image& picture_;
  float share_, floor_, mean_;
};

/// The mean of the squares over a pixel and its neighbours.
glm::vec3 mean_square_around(const Image& image, int x, int y) {
  glm::vec3 sum(0.0F);
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
      sum += image.at(u, v) * image.at(u, v);
  return sum / 9.0F;
}

} // namespace

SampleRange first_samples(const RenderSettings& settings) {
  constexpr int fewest = 4, part = growth * growth * growth;
  const int all = std::max(settings.samples, 1);
  return {0, settings.pixel_error > 0.0 ? std::min(all, std::max(fewest, all / part)) : all};
}

PixelMask uncertain_pixels(const Image& picture, double pixel_error) {
  constexpr float error_of_difference = 0.25F;
  const PixelBounds bounds(picture, pixel_error);
  PixelMask uncertain(picture.pixels.size(), 0);
  // Each pair of neighbours once: to the right and the three below.
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || nx >= picture.width || ny >= picture.height)
          continue;
        const glm::vec3 &a = picture.at(x, y), &b = picture.at(nx, ny);
        if (!bounds.passed_by(error_of_difference * glm::abs(a - b), glm::max(a, b)))
          continue;
        uncertain[static_cast<std::size_t>(y * picture.width + x)] = 1;
        uncertain[static_cast<std::size_t>(ny * picture.width + nx)] = 1;
      }
  return uncertain;
}

PixelMask uncertain_pixels(const Image& picture, const Image& change, double pixel_error) {
  constexpr float error_of_change = 0.45F;
  const PixelBounds bounds(picture, pixel_error);
  PixelMask uncertain(picture.pixels.size(), 0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * picture.width + x);
      // A line of three pixels has the root of a third of their mean square; a single one is believed as well.
      const glm::vec3 error =
          glm::max(glm::abs(change.at(x, y)), glm::sqrt(3.0F * mean_square_around(change, x, y)));
      uncertain[pixel] = bounds.passed_by(error_of_change * error, pixel) ? 1 : 0;
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

SampleCounts counts_of(const std::vector<SampleRound>& rounds, std::size_t pixels) {
  SampleCounts counts(pixels, 0);
  for (const SampleRound& round : rounds)
    for (std::size_t p = 0; p < pixels; ++p)
      if (round.pixels.empty() || round.pixels[p] != 0)
        counts[p] = static_cast<std::uint32_t>(round.samples.first + round.samples.count);
  return counts;
}

} // namespace meninas
