#include "raytrace/error/noise_choice.h"

#include "raytrace/pixels/pixel_neighbours.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas {

std::vector<double> squared_contrasts(const Image& picture, std::span<const std::uint8_t> emits) {
  std::vector<double> contrasts(picture.pixels.size(), 0.0);
  const auto place = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x);
  };
  for_each_neighbours(picture.width, picture.height, [&](int x, int y, int nx, int ny) {
    const std::size_t a = place(x, y), b = place(nx, ny);
    if (emits[a] != 0 || emits[b] != 0)
      return;
    const glm::dvec3 step = glm::dvec3(picture.pixels[a]) - glm::dvec3(picture.pixels[b]);
    contrasts[a] += glm::dot(step, step);
    contrasts[b] += glm::dot(step, step);
  });
  return contrasts;
}

std::vector<double> chances_by(std::span<const double> contrasts, std::size_t wanted) {
  const std::size_t count = contrasts.size();
  if (wanted >= count)
    return std::vector<double>(count, 1.0);
  if (wanted == 0)
    return std::vector<double>(count, 0.0);
  // Half evenly, half by the contrast, if there is any.
  const double sum = std::accumulate(contrasts.begin(), contrasts.end(), 0.0);
  const double even = 1.0 / double(count);
  std::vector<double> chances(count, even);
  if (std::isnormal(sum))
    std::ranges::transform(contrasts, chances.begin(),
                           [&](double c) { return 0.5 * (even + c / sum); });
  // Pixels whose chance would exceed 1 have 1,
  // and the others share the rest, until none exceeds 1.
  std::size_t certain = 0, before = 0;
  do {
    before = certain;
    double others = 0.0;
    for (const double chance : chances)
      others += chance < 1.0 ? chance : 0.0;
    const double scale = double(wanted - certain) / others;
    certain = 0;
    for (double& chance : chances) {
      chance = chance < 1.0 ? std::min(scale * chance, 1.0) : 1.0;
      certain += chance < 1.0 ? 0 : 1;
    }
  } while (certain != before);
  return chances;
}

std::vector<std::size_t> drawn_by(std::span<const double> chances, std::uint32_t seed) {
  std::vector<std::size_t> drawn;
  std::size_t held = 0; // the one that is not decided yet
  double left = 0.0;    // and the chance it has by now
  for (std::size_t k = 0; k < chances.size(); ++k) {
    const double u = double(hash(static_cast<std::uint32_t>(k), seed)) * 0x1p-32;
    const double chance = chances[k], sum = left + chance;
    if (sum < 1.0) {
      // One of the two has the chances of both, the other none.
      held = u * sum < chance ? k : held;
      left = sum;
    } else {
      // One of the two is drawn, the other has the chance that is left.
      const bool other = u * (2.0 - sum) < 1.0 - chance;
      drawn.push_back(other ? held : k);
      held = other ? k : held;
      left = sum - 1.0;
    }
  }
  if (left > 0.5)
    drawn.push_back(held); // the sum of the chances is whole but for rounding
  std::ranges::sort(drawn);
  return drawn;
}

ProbeChoice choose_redrawn(std::span<const glm::ivec2> pixels, std::span<const double> contrasts,
                           int width, std::size_t wanted, std::uint32_t seed) {
  std::vector<double> of_pixels;
  of_pixels.reserve(pixels.size());
  for (const glm::ivec2& p : pixels)
    of_pixels.push_back(contrasts[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(p.x)]);
  const std::vector<double> chances = chances_by(of_pixels, wanted);
  const std::vector<std::size_t> drawn = drawn_by(chances, seed);
  ProbeChoice choice;
  for (const std::size_t k : drawn) {
    choice.pixels.push_back(pixels[k]);
    choice.weight.push_back(double(drawn.size()) / (double(pixels.size()) * chances[k]));
  }
  return choice;
}

} // namespace meninas
