#include "image/metrics/changes.h"

#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

struct Region {
  int x0, y0, x1, y1; ///< x1 and y1 excluded
};

struct Sums {
  double squares = 0.0, picture = 0.0, reference = 0.0; ///< of differences; of luminance
};

double luminance(const glm::vec3& rgb) { return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b; }

double square(const glm::vec3& a, const glm::vec3& b) {
  const Vec3 d = Vec3(a) - Vec3(b);
  return glm::dot(d, d);
}

Sums sums_over(const Region& region, const Image& picture, const Image& reference) {
  Sums sums;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      sums.squares += square(picture.at(x, y), reference.at(x, y));
      sums.picture += luminance(picture.at(x, y));
      sums.reference += luminance(reference.at(x, y));
    }
  return sums;
}

std::string brightness(const Sums& sums) {
  if (sums.reference <= 0.0)
    return sums.picture > 0.0 ? "no longer black" : "as bright";
  const double percent = 100.0 * (sums.picture / sums.reference - 1.0);
  if (std::abs(percent) < 1e-4)
    return "as bright";
  return fmt::format("{:.2g} % {}", std::abs(percent), percent > 0.0 ? "brighter" : "darker");
}

std::string colour(const glm::vec3& rgb) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", rgb.r, rgb.g, rgb.b);
}

Region worst_region(const Image& picture, const Image& reference) {
  constexpr int parts = 8;
  Region worst{0, 0, picture.width, picture.height};
  double most = -1.0;
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i) {
      const Region region{picture.width * i / parts, picture.height * j / parts,
                          picture.width * (i + 1) / parts, picture.height * (j + 1) / parts};
      const bool empty = region.x0 == region.x1 || region.y0 == region.y1;
      const double squares = sums_over(region, picture, reference).squares;
      if (!empty && squares > most) {
        most = squares;
        worst = region;
      }
    }
  return worst;
}

} // namespace

std::string describe_change(const Image& picture, const Image& reference, const std::string& unit) {
  expects(picture.width == reference.width && picture.height == reference.height,
          "pictures that are compared have one size");
  const Region region = worst_region(picture, reference);
  const Region whole{0, 0, picture.width, picture.height};
  std::size_t worst = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < picture.pixels.size(); ++k)
    if (const double d = square(picture.pixels[k], reference.pixels[k]); d > most) {
      most = d;
      worst = k;
    }
  const auto width = static_cast<std::size_t>(picture.width);
  return fmt::format(
      "most at x {}-{}, y {}-{}: {}; whole picture {}; worst pixel ({}, {}): {}, was {} {}", region.x0,
      region.x1 - 1, region.y0, region.y1 - 1, brightness(sums_over(region, picture, reference)),
      brightness(sums_over(whole, picture, reference)), worst % width, worst / width,
      colour(picture.pixels[worst]), colour(reference.pixels[worst]), unit);
}

} // namespace meninas
