#include "image/colour_scale.h"

#include "image/colour_map.h"
#include "image/display.h"
#include "image/lettering.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

glm::vec3 linear(const glm::vec3& encoded) {
  return {srgb_decode(encoded.r), srgb_decode(encoded.g), srgb_decode(encoded.b)};
}

/// Lengths of the legend, in pixels.
struct Layout {
  int dot;    ///< pixels per dot of a letter
  int margin; ///< on the left and right of the bar
  int bar;    ///< height of the bar
  int height() const { return 3 * gap() + 2 * letter_height * dot + bar + tick(); }
  int gap() const { return 4 * dot; }
  int tick() const { return 3 * dot; }
};

/// Letters as large as leaves room for the title.
Layout layout_of(int width, std::string_view title, int largest_dot) {
  const int margin = std::max(16, width / 32);
  const int room = (width - 2 * margin) / std::max(1, text_width(title, 1));
  const int dot = std::max(1, std::min(largest_dot, room));
  return {.dot = dot, .margin = margin, .bar = 12 * dot};
}

/// Whether a line between two values lies between these pixels. Where values differ by more than a
/// quarter of a step they are of different things, and lines would be no farther apart than they are wide.
bool crosses(float a, float b, double step) {
  return std::floor(a / step) != std::floor(b / step) && std::abs(double{a} - b) < 0.25 * step;
}

} // namespace

double scale_start(const ColourScale& scale) {
  return scale.scale == ErrorScale::magnitude ? 0.0 : -scale.top;
}

glm::vec3 scale_background() { return linear(glm::vec3(0.2F)); }

void fill(Image& picture, int x0, int y0, int x1, int y1, const glm::vec3& colour) {
  for (int y = std::max(y0, 0); y < std::min(y1, picture.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, picture.width); ++x)
      picture.at(x, y) = colour;
}

double readable_top(const Channel& values) {
  std::vector<float> sorted = values.values;
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

glm::vec3 scale_colour(double place, ErrorScale scale) {
  return linear(scale == ErrorScale::magnitude ? magma(place) : blue_orange(2.0 * place - 1.0));
}

int scale_ticks(ErrorScale scale) { return scale == ErrorScale::magnitude ? 5 : 4; }

int scale_height(int width, const ColourScale& scale, int largest_dot) {
  return layout_of(width, scale.title, largest_dot).height();
}

void draw_scale(Image& picture, int top, const ColourScale& scale, int largest_dot) {
  const Layout layout = layout_of(picture.width, scale.title, largest_dot);
  fill(picture, 0, top, picture.width, top + layout.height(), scale_background());
  const glm::vec3 ink(1.0F);
  const int left = layout.margin, right = picture.width - layout.margin;
  int y = top + layout.gap();
  draw_text(picture, left, y, scale.title, layout.dot, ink);
  y += letter_height * layout.dot + layout.gap();
  for (int x = left; x < right; ++x)
    fill(picture, x, y, x + 1, y + layout.bar,
         scale_colour(static_cast<double>(x - left) / (right - left - 1), scale.scale));
  y += layout.bar;
  const double from = scale_start(scale), length = scale.top - from;
  const int ticks = scale_ticks(scale.scale);
  for (int k = 0; k <= ticks; ++k) {
    const int x = left + (right - left - 1) * k / ticks;
    fill(picture, x, y, x + layout.dot, y + layout.tick(), ink);
    const std::string number = fmt::format("{:.5g}", from + length * k / ticks);
    const int width = text_width(number, layout.dot);
    const int start = std::clamp(x - width / 2, 1, std::max(1, picture.width - width - 1));
    draw_text(picture, start, y + layout.tick() + layout.dot, number, layout.dot, ink);
  }
}

Image false_colours(const Channel& values, const Channel& known, const ColourScale& scale) {
  expects(scale.top > 0.0, "a scale has a length");
  constexpr int lines = 10;
  constexpr double bright = 0.6; // of the scale: from here on lines are black
  const double step = scale.top / lines;
  Image picture(values.width, values.height);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) {
      if (known.at(x, y) == 0.0F)
        continue;
      const float value = values.at(x, y);
      const auto to_neighbour = [&](int u, int v) {
        return u < values.width && v < values.height && known.at(u, v) != 0.0F &&
               std::max(value, values.at(u, v)) < scale.top && crosses(value, values.at(u, v), step);
      };
      const bool on_line = to_neighbour(x + 1, y) || to_neighbour(x, y + 1);
      picture.at(x, y) = on_line ? glm::vec3(value > bright * scale.top ? 0.0F : 1.0F)
                                 : scale_colour(value / scale.top, scale.scale);
    }
  // At most a fifth of the picture, and wide enough for its numbers.
  constexpr int min_width = 160;
  const int dot = std::max(1, values.width / 512);
  const int height = scale_height(values.width, scale, dot);
  if (values.width >= min_width && 5 * height <= values.height)
    draw_scale(picture, values.height - height, scale, dot);
  return picture;
}

} // namespace meninas
