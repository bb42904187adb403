#include "raytrace/pixels/bright_edges.h"

#include "raytrace/pixels/pixel_neighbours.h"

#include <algorithm>
#include <cmath>

namespace meninas {

PixelMask bright_edges(const Image& picture, double exposure) {
  constexpr float clearly_less = 0.75F;
  const auto white = static_cast<float>(std::exp2(-exposure));
  const auto brightest = [&](int x, int y) {
    const glm::vec3& p = picture.at(x, y);
    return std::max({p.r, p.g, p.b});
  };
  PixelMask edges(picture.pixels.size(), 0);
  const auto edge = [&](int x, int y) -> std::uint8_t& {
    return edges[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                 static_cast<std::size_t>(x)];
  };
  for_each_neighbours(picture.width, picture.height, [&](int x, int y, int u, int v) {
    const float one = brightest(x, y), other = brightest(u, v);
    if (std::max(one, other) >= white && std::min(one, other) < clearly_less * std::max(one, other))
      edge(x, y) = edge(u, v) = 1;
  });
  return edges;
}

std::vector<ShownPixel> shown_at_edges(const Image& picture, const PixelMask& pixels, int samples,
                                       const TraceSamples& straight, const ShownPixels& display) {
  const double scale = std::exp2(display.exposure);
  const auto width = static_cast<std::size_t>(picture.width);
  const auto number = [&](int x, int y) {
    return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
  };
  std::vector<std::uint32_t> place(pixels.size(), 0);
  std::vector<ShownPixel> shown;
  for (std::size_t p = 0; p < pixels.size(); ++p)
    if (pixels[p] != 0) {
      place[p] = static_cast<std::uint32_t>(shown.size());
      shown.push_back({p, glm::vec3(0.0F)});
    }

  // The part of the pixel's mean that its samples do not see straight.
  std::vector<glm::vec3> besides(shown.size());
  straight({{0, samples}, &pixels}, [&](int x, int y, const SeenRadiance& seen) {
    besides[place[number(x, y)]] = picture.at(x, y) - (seen[0] + seen[1] + seen[2]);
  });
  // A draw of one sample a pixel shows what each of them is by itself.
  for (int k = 0; k < samples; ++k)
    straight({{k, 1}, &pixels}, [&](int x, int y, const SeenRadiance& seen) {
      const std::uint32_t at = place[number(x, y)];
      const glm::dvec3 radiance(seen[0] + seen[1] + seen[2] + besides[at]);
      shown[at].shown += glm::vec3(displayed(display.transform, scale * radiance)) /
                         static_cast<float>(samples);
    });
  return shown;
}

} // namespace meninas
