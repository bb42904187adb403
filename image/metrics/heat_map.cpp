#include "image/metrics/heat_map.h"

#include "image/colour_map.h"
#include "image/display.h"
#include "image/lettering.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

constexpr int wanted_width = 512; ///< of the picture, before pixels get larger than one

glm::vec3 linear(const glm::vec3& encoded) {
  return {srgb_decode(encoded.r), srgb_decode(encoded.g), srgb_decode(encoded.b)};
}

void fill(Image& picture, int x0, int y0, int x1, int y1, const glm::vec3& colour) {
  for (int y = std::max(y0, 0); y < std::min(y1, picture.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, picture.width); ++x)
      picture.at(x, y) = colour;
}

/// Lengths of the legend, in pixels.
struct Layout {
  int scale;  ///< pixels per dot of a letter
  int margin; ///< on the left and right of the bar
  int bar;    ///< height of the bar
  int height() const { return 3 * gap() + 2 * letter_height * scale + bar + tick(); }
  int gap() const { return 4 * scale; }
  int tick() const { return 3 * scale; }
};

/// Letters as large as leaves room for the title.
Layout layout_of(int width, std::string_view title) {
  const int margin = std::max(16, width / 32);
  const int room = (width - 2 * margin) / std::max(1, text_width(title, 1));
  const int scale = std::max(1, std::min(width / 256, room));
  return {.scale = scale, .margin = margin, .bar = 12 * scale};
}

/// The colour at a place along the scale, 0 at its left end.
glm::vec3 colour_at(double place, ErrorScale scale) {
  return linear(scale == ErrorScale::magnitude ? magma(place) : blue_orange(2.0 * place - 1.0));
}

double lower_end(const HeatMapSettings& settings) {
  return settings.scale == ErrorScale::magnitude ? 0.0 : -settings.top;
}

void draw_legend(Image& picture, int top, const Layout& layout, const HeatMapSettings& settings) {
  const glm::vec3 ink(1.0F);
  const int left = layout.margin, right = picture.width - layout.margin;
  int y = top + layout.gap();
  draw_text(picture, left, y, settings.title, layout.scale, ink);
  y += letter_height * layout.scale + layout.gap();
  for (int x = left; x < right; ++x)
    fill(picture, x, y, x + 1, y + layout.bar,
         colour_at(static_cast<double>(x - left) / (right - left - 1), settings.scale));
  y += layout.bar;
  const double from = lower_end(settings), length = settings.top - from;
  const int ticks = settings.scale == ErrorScale::magnitude ? 5 : 4;
  for (int k = 0; k <= ticks; ++k) {
    const int x = left + (right - left - 1) * k / ticks;
    fill(picture, x, y, x + layout.scale, y + layout.tick(), ink);
    const std::string number = fmt::format("{:.3g}", from + length * k / ticks);
    const int width = text_width(number, layout.scale);
    const int start = std::clamp(x - width / 2, 1, std::max(1, picture.width - width - 1));
    draw_text(picture, start, y + layout.tick() + layout.scale, number, layout.scale, ink);
  }
}

} // namespace

Channel signed_difference(const Image& picture, const Image& reference) {
  const glm::vec3 luminance{0.2126F, 0.7152F, 0.0722F};
  Channel difference(picture.width, picture.height);
  for (std::size_t p = 0; p < difference.values.size(); ++p)
    difference.values[p] = glm::dot(luminance, picture.pixels[p] - reference.pixels[p]);
  return difference;
}

double readable_top(const Channel& errors) {
  std::vector<float> sorted = errors.values;
  for (float& value : sorted)
    value = std::abs(value);
  const auto rank = static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  double value = sorted[static_cast<std::size_t>(rank)];
  if (!(value > 0.0))
    value = *std::ranges::max_element(sorted);
  if (!(value > 0.0))
    return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power)
      return step * power;
  return 10.0 * power;
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
  const Layout layout = layout_of(width, settings.title);
  Image picture(width, map_height + layout.height());
  fill(picture, 0, 0, width, picture.height, linear(glm::vec3(0.2F)));

  const int left = (width - magnified * errors.width) / 2;
  const double from = lower_end(settings), length = settings.top - from;
  for (int y = 0; y < errors.height; ++y)
    for (int x = 0; x < errors.width; ++x)
      fill(picture, left + x * magnified, y * magnified, left + (x + 1) * magnified,
           (y + 1) * magnified, colour_at((errors.at(x, y) - from) / length, settings.scale));
  draw_legend(picture, map_height, layout, settings);
  return picture;
}

} // namespace meninas
