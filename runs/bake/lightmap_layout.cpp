#include "runs/bake/lightmap_layout.h"

#include "runs/bake/chart_packing.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

int intervals_at(int roots, int level, int detail) {
  return static_cast<int>(std::ceil(std::ldexp(double(roots), std::min(level, detail))));
}

bool is_single(const Chart& chart, double root_size, int detail) {
  return detail < 0 && chart.length < 0.5 * std::ldexp(root_size, -detail);
}

/// Rectangles with their gutters: the block of single texels first, the dark one among them.
struct Rectangles {
  std::vector<glm::ivec2> sizes;
  double area = 0.0;
  int largest = 0;
};

Rectangles rectangles_of(const std::vector<ChartTexels>& charts, std::size_t single) {
  constexpr int around = 2 * lightmap_gutter;
  const int side = static_cast<int>(std::ceil(std::sqrt(double(single + 1))));
  Rectangles all{{glm::ivec2(side + around)}};
  for (const ChartTexels& chart : charts)
    if (chart.intervals.x > 0)
      all.sizes.push_back(chart.intervals + 1 + around);
  for (const glm::ivec2& size : all.sizes) {
    all.area += double(size.x) * size.y;
    all.largest = std::max({all.largest, size.x, size.y});
  }
  return all;
}

LightmapLayout at_detail(const std::vector<Chart>& charts, double root_size, int detail) {
  LightmapLayout layout;
  layout.detail = detail;
  for (const Chart& chart : charts) {
    ChartTexels& texels = layout.charts.emplace_back();
    if (is_single(chart, root_size, detail))
      ++layout.single;
    else
      texels.intervals = {intervals_at(chart.roots[0], chart.level, detail),
                          intervals_at(chart.roots[1], chart.level, detail)};
  }
  return layout;
}

bool place_charts(LightmapLayout& layout, const Rectangles& rectangles, int size) {
  if (rectangles.largest > size || rectangles.area > double(size) * size)
    return false;
  const auto places = pack_rectangles(rectangles.sizes, glm::ivec2(size));
  if (!places)
    return false;
  const int row = rectangles.sizes[0].x - 2 * lightmap_gutter;
  const glm::ivec2 block = (*places)[0] + lightmap_gutter;
  int next_single = 0;
  const auto next_in_block = [&] {
    const int k = next_single++;
    return block + glm::ivec2(k % row, k / row);
  };
  layout.dark = next_in_block();
  std::size_t next = 1;
  for (ChartTexels& chart : layout.charts)
    chart.first = chart.intervals.x > 0 ? (*places)[next++] + lightmap_gutter : next_in_block();
  layout.width = size;
  for (std::size_t k = 0; k < places->size(); ++k)
    layout.height = std::max(layout.height, (*places)[k].y + rectangles.sizes[k].y);
  return true;
}

} // namespace

LightmapLayout lay_out(const std::vector<Chart>& charts, double root_size, int size) {
  int full = 0;
  for (const Chart& chart : charts)
    full = std::max(full, chart.level);
  constexpr int coarsest = -40; // by then every face has one texel
  for (int detail = full; detail >= coarsest; --detail) {
    LightmapLayout layout = at_detail(charts, root_size, detail);
    layout.full_detail = full;
    const Rectangles rectangles = rectangles_of(layout.charts, layout.single);
    for (int side = 64; side < size && detail == full; side *= 2)
      if (place_charts(layout, rectangles, side))
        return layout;
    if (place_charts(layout, rectangles, size))
      return layout;
  }
  const auto least = static_cast<int>(std::ceil(std::sqrt(double(charts.size() + 1)))) + 2 * lightmap_gutter;
  throw UsageError("--lightmap-size",
                   fmt::format("{} is too small for {} faces: it takes {} at the least", size,
                               charts.size(), least));
}

glm::vec2 texcoord_of(const LightmapLayout& layout, const ChartPoint& point) {
  Vec2 texel(layout.dark);
  if (point.chart != no_chart) {
    const ChartTexels& chart = layout.charts[point.chart];
    texel = Vec2(chart.first) + point.at * Vec2(chart.intervals);
  }
  return glm::vec2((texel + 0.5) / Vec2(layout.width, layout.height));
}

} // namespace meninas
