#include "image/metrics/heat_map.h"

#include "image/display.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

constexpr int wanted_width = 512; ///< of the picture, before pixels get larger than one

} // namespace

Channel signed_difference(const Image& picture, const Image& reference) {
  const glm::vec3 luminance{0.2126F, 0.7152F, 0.0722F};
  Channel difference(picture.width, picture.height);
  for (std::size_t p = 0; p < difference.values.size(); ++p)
    difference.values[p] = glm::dot(luminance, picture.pixels[p] - reference.pixels[p]);
  return difference;
}

HeatMapSettings heat_map_settings(const PictureDifference& difference, Metric metric,
                                  const Channel& errors) {
  const auto largest = std::ranges::max_element(errors.values);
  const auto place = static_cast<int>(largest - errors.values.begin());
  return {.title = fmt::format("{} {:.3g}, max {:.3g} at {},{}", name_of(metric),
                               value_of(difference, metric), *largest, place % errors.width,
                               place / errors.width),
          .top = metric == Metric::flip ? 1.0 : readable_top(errors)};
}

Image heat_map(const Channel& errors, const HeatMapSettings& settings) {
  expects(settings.top > 0.0, "a scale has a length");
  const int magnified = std::max(1, wanted_width / errors.width);
  const int map_height = magnified * errors.height;
  const int width = std::max(magnified * errors.width, wanted_width);
  const int largest_dot = width / 256;
  Image picture(width, map_height + scale_height(width, settings, largest_dot));
  fill(picture, 0, 0, width, picture.height, scale_background());

  const int left = (width - magnified * errors.width) / 2;
  const double from = scale_start(settings), length = settings.top - from;
  for (int y = 0; y < errors.height; ++y)
    for (int x = 0; x < errors.width; ++x)
      fill(picture, left + x * magnified, y * magnified, left + (x + 1) * magnified,
           (y + 1) * magnified, scale_colour((errors.at(x, y) - from) / length, settings.scale));
  draw_scale(picture, map_height, settings, largest_dot);
  return picture;
}

} // namespace meninas
