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

std::vector<ShownPixel> shown_at_edges(const RenderSettings& settings, const TraceSamples& trace,
                                       const PixelMask& pixels, const ShownPixels& display) {
  const double scale = std::exp2(display.exposure);
  const auto width = static_cast<std::size_t>(settings.width);
  std::vector<glm::dvec3> sums(pixels.size(), glm::dvec3(0.0));
  // A draw of one sample a pixel shows what each of them is by itself.
  for (int k = 0; k < settings.samples; ++k)
    trace({{k, 1}, &pixels}, [&](int x, int y, const SeenRadiance& seen) {
      const glm::dvec3 radiance(seen[0] + seen[1] + seen[2]);
      sums[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] +=
          displayed(display.transform, scale * radiance);
    });
  std::vector<ShownPixel> shown;
  for (std::size_t p = 0; p < pixels.size(); ++p)
    if (pixels[p] != 0)
      shown.push_back({p, glm::vec3(sums[p] / double(settings.samples))});
  return shown;
}

} // namespace meninas
