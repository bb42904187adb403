#include "runs/bake/lightmap.h"

#include "image/codecs/png_encoding.h"
#include "image/display.h"
#include "image/image_file.h"
#include "radiosity/scene/surface_colour.h"
#include "radiosity/solution/scene_places.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace meninas {

namespace {

/// The sides of a texel in the weights of the triangle that it lies on.
Footprint footprint_of(const LightScene& light, const Chart& chart, TriangleId triangle, Vec2 step) {
  const auto change = [&](Vec2 by) {
    return barycentric_at(light, chart, triangle, by) - barycentric_at(light, chart, triangle, Vec2(0.0));
  };
  return {change({step.x, 0.0}), change({0.0, step.y})};
}

/// (E + rho H) / pi.
glm::vec3 radiance_of(const LightScene& light, const Chart& chart, const ChartPlace& place, Vec2 step,
                      const glm::vec3& received) {
  const SurfaceColour colour =
      surface_colour(light.scene, light.textures, place.triangle, place.barycentric,
                     footprint_of(light, chart, place.triangle, step));
  return glm::vec3((colour.emission + colour.reflectance * Rgb(received)) / std::numbers::pi);
}

/// COLOR_0 there, far enough from black to divide by.
glm::vec3 colour_of_vertices(const LightScene& light, const ChartPlace& place) {
  constexpr float least = 1e-3F;
  return glm::max(glm::vec3(vertex_colour(light.scene, {place.triangle, place.barycentric})), glm::vec3(least));
}

/// The texels of one chart.
class ChartFiller {
public:
  ChartFiller(const IrradianceField& field, const VertexIrradiance& values, const Chart& chart,
              const ChartTexels& texels)
      : field_(field), values_(values), chart_(chart), texels_(texels),
        step_(1.0 / Vec2(glm::max(texels.intervals, glm::ivec2(1)))) {}

  void fill(Lightmap& map) const {
    const bool single = texels_.intervals.x == 0;
    const Vec2 middle(chart_.triangle ? 1.0 / 3.0 : 0.5);
    const auto place_at = [&](glm::ivec2 k) {
      return place_in_scene(*field_.scene, chart_, single ? middle : Vec2(k) * step_);
    };
    each_own([&](glm::ivec2 k) { at(map.irradiance, k) = irradiance_at(field_, values_, chart_, place_at(k)); });
    light_what_is_covered(map.irradiance);
    if (!map.shown.pixels.empty())
      each_own([&](glm::ivec2 k) { at(map.shown, k) = shown_at(place_at(k), at(map.irradiance, k)); });
    if (single)
      return;
    for (Image* image : {&map.irradiance, &map.shown})
      if (!image->pixels.empty()) {
        if (chart_.triangle)
          extend_triangle(*image);
        fill_gutter(*image);
      }
  }

private:
  glm::vec3& at(Image& image, glm::ivec2 k) const {
    return image.at(texels_.first.x + k.x, texels_.first.y + k.y);
  }

  bool is_own(glm::ivec2 k) const {
    const glm::ivec2 n = texels_.intervals;
    return k.x >= 0 && k.y >= 0 && k.x <= n.x && k.y <= n.y && (!chart_.triangle || k.x + k.y <= n.x);
  }

  template <typename Visit>
  void each_own(Visit visit) const {
    for (int j = 0; j <= texels_.intervals.y; ++j)
      for (int i = 0; i <= texels_.intervals.x; ++i)
        if (is_own({i, j}))
          visit(glm::ivec2(i, j));
  }

  glm::vec3 shown_at(const ChartPlace& place, const glm::vec3& received) const {
    const LightScene& light = *field_.scene;
    return radiance_of(light, chart_, place, step_, received) / colour_of_vertices(light, place);
  }

  /// Below what stands on a face nothing is received and nothing seen: beside what is seen such texels take
  /// the mean of their neighbours, for filtering would make a dark edge of them.
  void light_what_is_covered(Image& image) const {
    std::vector<std::pair<glm::ivec2, glm::vec3>> lit;
    each_own([&](glm::ivec2 k) {
      if (at(image, k) != glm::vec3(0.0F))
        return;
      glm::vec3 sum(0.0F);
      float count = 0.0F;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (const glm::ivec2 beside = k + glm::ivec2(dx, dy);
              is_own(beside) && at(image, beside) != glm::vec3(0.0F)) {
            sum += at(image, beside);
            count += 1.0F;
          }
      if (count > 0.0F)
        lit.emplace_back(k, sum / count);
    });
    for (const auto& [k, value] : lit)
      at(image, k) = value;
  }

  /// f(i, j) = f(i - 1, j) + f(i, j - 1) - f(i - 1, j - 1) beside the edge i + j = n.
  void extend_triangle(Image& image) const {
    const int n = texels_.intervals.x;
    for (int j = 1; j <= n; ++j) {
      const int i = n + 1 - j;
      const glm::vec3 next = at(image, {i - 1, j}) + at(image, {i, j - 1}) - at(image, {i - 1, j - 1});
      for (int k = i; k <= n; ++k)
        at(image, {k, j}) = glm::max(next, glm::vec3(0.0F));
    }
  }

  void fill_gutter(Image& image) const {
    const glm::ivec2 n = texels_.intervals;
    for (int j = -lightmap_gutter; j <= n.y + lightmap_gutter; ++j)
      for (int i = -lightmap_gutter; i <= n.x + lightmap_gutter; ++i) {
        at(image, {i, j}) = at(image, glm::clamp(glm::ivec2(i, j), glm::ivec2(0), n));
      }
  }

  const IrradianceField& field_;
  const VertexIrradiance& values_;
  const Chart& chart_;
  const ChartTexels& texels_;
  Vec2 step_;
};

/// Calls visit(chart, texel, its place in the chart) for the texels inside of charts.
template <typename Visit>
void each_texel(const std::vector<Chart>& charts, const LightmapLayout& layout, Visit visit) {
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const auto& [first, n] = layout.charts[c];
    const Vec2 steps(glm::max(n, glm::ivec2(1)));
    for (int j = 0; j <= n.y; ++j)
      for (int i = 0; i <= n.x; ++i)
        if (!charts[c].triangle || i + j <= n.x)
          visit(charts[c], first + glm::ivec2(i, j), Vec2(i, j) / steps);
  }
}

/// So that the radiance is well exposed.
void expose(Lightmap& map, const LightScene& light, const std::vector<Chart>& charts,
            const LightmapLayout& layout) {
  Image lit;
  each_texel(charts, layout, [&](const Chart& chart, glm::ivec2 texel, Vec2 at) {
    lit.pixels.push_back(map.shown.at(texel.x, texel.y) *
                         colour_of_vertices(light, place_in_scene(light, chart, at)));
  });
  lit.width = static_cast<int>(lit.pixels.size());
  lit.height = 1;
  map.exposure = lit.pixels.empty() ? 0.0 : automatic_exposure(lit);
  const float scale = std::exp2(static_cast<float>(map.exposure));
  for (glm::vec3& pixel : map.shown.pixels)
    pixel *= scale;
}

/// The least factor that clips no more than a thousandth of the texels.
void choose_factor(Lightmap& map, const std::vector<Chart>& charts, const LightmapLayout& layout) {
  std::vector<float> values;
  each_texel(charts, layout, [&](const Chart&, glm::ivec2 texel, Vec2) {
    values.push_back(largest(map.irradiance.at(texel.x, texel.y)));
  });
  if (values.empty())
    return;
  map.brightest = double(*std::ranges::max_element(values));
  const auto kept = values.begin() + static_cast<std::ptrdiff_t>(double(values.size() - 1) * 0.999);
  std::ranges::nth_element(values, kept);
  map.factor = *kept > 0.0F ? double(*kept) : map.brightest > 0.0 ? map.brightest : 1.0;
}

} // namespace

/// Where texels are rounded up, of a sequence that is even over any neighbourhood (R2: Roberts 2018, The Unreasonable
/// Effectiveness of Quasirandom Sequences): dark gradients have no bands, for filtering shows the mean.
static float rounding_threshold(int x, int y) {
  constexpr double a = 0.7548776662466927, b = 0.5698402909980532;
  const double t = a * x + b * y;
  return static_cast<float>(t - std::floor(t));
}

/// Codes of sRGB. Between two of them light is rounded up as often as makes their mean its own, for what filters decodes first.
static std::vector<std::uint8_t> rounded_codes(const Image& image, double scale) {
  std::array<float, 256> linear{};
  for (std::size_t code = 0; code < linear.size(); ++code)
    linear[code] = srgb_decode(static_cast<float>(code) / 255.0F);
  std::vector<std::uint8_t> codes;
  codes.reserve(3 * image.pixels.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float threshold = rounding_threshold(x, y);
      for (int c = 0; c < 3; ++c) {
        const float light = std::clamp(static_cast<float>(scale) * image.at(x, y)[c], 0.0F, 1.0F);
        const auto above = std::ranges::upper_bound(linear, light);
        const auto code = static_cast<std::size_t>(above - linear.begin()) - 1;
        const bool up = above != linear.end() &&
                        light - linear[code] > (1.0F - threshold) * (linear[code + 1] - linear[code]);
        codes.push_back(static_cast<std::uint8_t>(code + (up ? 1 : 0)));
      }
    }
  return codes;
}

Lightmap fill_lightmap(const IrradianceField& field, const VertexIrradiance& values,
                       const std::vector<Chart>& charts, const LightmapLayout& layout,
                       WithShown with_shown) {
  Lightmap map;
  map.irradiance = Image(layout.width, layout.height);
  if (with_shown == WithShown::yes)
    map.shown = Image(layout.width, layout.height);
  tbb::parallel_for(std::size_t{0}, charts.size(), [&](std::size_t c) {
    ChartFiller(field, values, charts[c], layout.charts[c]).fill(map);
  });
  choose_factor(map, charts, layout);
  if (with_shown == WithShown::yes)
    expose(map, *field.scene, charts, layout);
  return map;
}

std::vector<std::byte> irradiance_png(const Lightmap& map) {
  return encode_png(
      map.irradiance.width, map.irradiance.height, rounded_codes(map.irradiance, 1.0 / map.factor), Compression::small,
      {"Comment", fmt::format("sRGB; irradiance in W/m^2 is {:.9g} of the decoded colour", map.factor)});
}

std::vector<std::byte> shown_png(const Lightmap& map) {
  return encode_png(map.shown, 0.0);
}

} // namespace meninas
