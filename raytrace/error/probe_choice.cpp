#include "raytrace/error/probe_choice.h"

#include "raytrace/error/probes.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas {

/// Well spread over the picture; any first ones of them are spread as well.
static std::vector<glm::ivec2> spread_pixels(const RenderSettings& settings,
                                             std::span<const std::uint8_t> emits,
                                             std::size_t wanted) {
  std::vector<glm::ivec2> pixels;
  const auto tries = static_cast<std::uint32_t>(8 * wanted);
  for (std::uint32_t k = 0; k < tries && pixels.size() < wanted; ++k) {
    const auto at = sobol4(k, hash(settings.seed, 0xe44));
    const glm::ivec2 pixel(
        std::min(static_cast<int>(at[0] * float(settings.width)), settings.width - 1),
        std::min(static_cast<int>(at[1] * float(settings.height)), settings.height - 1));
    if (emits[static_cast<std::size_t>(pixel.y * settings.width + pixel.x)] == 0)
      pixels.push_back(pixel);
  }
  return pixels;
}

/// By vertex of the cells, how far a value is from the mean of those an edge away.
static std::vector<glm::vec3> bends(std::span<const ElementCorners> cells,
                                    const std::vector<glm::vec3>& irradiance) {
  std::vector<glm::vec3> sums(irradiance.size(), glm::vec3(0.0F));
  std::vector<float> counts(irradiance.size(), 0.0F);
  for (const ElementCorners& corners : cells)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = index(corners[c]), b = index(corners[(c + 1) % 4]);
      if (a == b)
        continue;
      sums[a] += irradiance[b];
      sums[b] += irradiance[a];
      counts[a] += 1.0F;
      counts[b] += 1.0F;
    }
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = glm::abs(irradiance[v] - sums[v] / std::max(counts[v], 1.0F));
  return sums;
}

/// V, by one ray a pixel. For a large picture a smaller one is good enough.
static Image bend_picture(const IrradianceField& field, FieldContent light,
                          const Camera& camera, RenderSettings settings) {
  constexpr double max_pixels = 20'000.0;
  const double smaller =
      std::min(1.0, std::sqrt(max_pixels / (double(settings.width) * settings.height)));
  settings.width = static_cast<int>(std::ceil(smaller * settings.width));
  settings.height = static_cast<int>(std::ceil(smaller * settings.height));
  settings.samples = 1;
  settings.diffuse.term = DiffuseTerm::interpolated;
  VisibleLight visible = visible_light(field, light);
  visible.irradiance = bends(visible.corners, visible.irradiance);
  visible.background = glm::vec3(0.0F);
  visible.sky = nullptr;
  for (SideShading& side : visible.shading)
    side.emitted = glm::vec3(0.0F);
  return first_picture(*field.scene, visible, camera, settings);
}

namespace {

/// The pixels of a picture by V^2, all channels together.
class BendMap {
public:
  BendMap(const Image& bend, const RenderSettings& settings, std::span<const std::uint8_t> emits)
      : cells_(bend.width, bend.height), size_(settings.width, settings.height), emits_(emits) {
    for (const glm::vec3& v : bend.pixels)
      squares_.push_back(glm::dot(glm::dvec3(v), glm::dvec3(v)));
    for (int y = 0; y < cells_.y; ++y)
      for (int x = 0; x < cells_.x; ++x) {
        const auto inside = static_cast<double>(pixels_of({x, y}).size());
        count_ += inside;
        sums_.push_back(sum() + inside * squares_[sums_.size()]);
      }
  }

  double sum() const { return sums_.empty() ? 0.0 : sums_.back(); }

  /// V^2 over its mean.
  double share(glm::ivec2 pixel) const {
    const glm::ivec2 cell = pixel * cells_ / size_;
    return squares_[static_cast<std::size_t>(cell.y * cells_.x + cell.x)] * count_ / sum();
  }

  /// With probability V^2 / sum V^2, for u and v even in [0, 1).
  glm::ivec2 pixel_at(double u, double v) const {
    const auto found = std::ranges::upper_bound(sums_, u * sum());
    const auto cell = static_cast<int>(std::min(found, sums_.end() - 1) - sums_.begin());
    const auto inside = pixels_of({cell % cells_.x, cell / cells_.x});
    return inside[static_cast<std::size_t>(v * double(inside.size()))];
  }

private:
  /// The pixels of a cell outside emitters.
  std::vector<glm::ivec2> pixels_of(glm::ivec2 cell) const {
    const auto first = [&](glm::ivec2 c) { return (c * size_ + cells_ - 1) / cells_; };
    const glm::ivec2 from = first(cell), to = first(cell + 1);
    std::vector<glm::ivec2> inside;
    for (int y = from.y; y < to.y; ++y)
      for (int x = from.x; x < to.x; ++x)
        if (emits_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
                   static_cast<std::size_t>(x)] == 0)
          inside.emplace_back(x, y);
    return inside;
  }

  glm::ivec2 cells_, size_;
  std::span<const std::uint8_t> emits_;
  std::vector<double> squares_; ///< by cell, row by row
  std::vector<double> sums_;    ///< over the pixels up to each cell's
  double count_ = 0.0;          ///< of pixels
};

} // namespace

ProbeChoice choose_probes(const IrradianceField& field, FieldContent light,
                          const Camera& camera, const RenderSettings& settings,
                          std::span<const std::uint8_t> emits, int wanted) {
  const std::vector<glm::ivec2> even =
      spread_pixels(settings, emits, static_cast<std::size_t>(wanted));
  const BendMap map(bend_picture(field, light, camera, settings), settings, emits);
  if (!(map.sum() > 0.0))
    return {even, std::vector<double>(even.size(), 1.0)};
  ProbeChoice choice;
  for (std::uint32_t k = 0; k < even.size(); ++k) {
    const auto at = sobol4(k / 2, hash(settings.seed, 0xc40ce));
    const glm::ivec2 pixel = k % 2 == 0 ? even[k / 2] : map.pixel_at(at[0], at[1]);
    choice.pixels.push_back(pixel);
    choice.weight.push_back(2.0 / (1.0 + map.share(pixel)));
  }
  return choice;
}

} // namespace meninas
