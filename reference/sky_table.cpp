#include "reference/sky_table.h"

#include "scenes/photometry.h"
#include "scenes/sky/radiance_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace meninas::reference {

namespace {

/// The mean luminance of a texel between itself and its neighbours, over itself.
class MeanLuminance {
public:
  explicit MeanLuminance(const RadianceMap& map) : map_(map) {}

  double operator()(int column, int row) const {
    return 0.125 * of_row(column, row - 1) + 0.75 * of_row(column, row) +
           0.125 * of_row(column, row + 1);
  }

private:
  double of_row(int column, int row) const {
    const int y = std::clamp(row, 0, map_.height - 1), w = map_.width;
    const auto at = [&](int x) {
      return luminance_of(
          map_.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                      static_cast<std::size_t>((x + w) % w)]);
    };
    return 0.125 * at(column - 1) + 0.75 * at(column) + 0.125 * at(column + 1);
  }

  const RadianceMap& map_;
};

/// Replaces numbers by their sums up to and with each, over the last of these, which is returned.
double accumulate(std::span<const double> values, std::span<float> sums) {
  double sum = 0.0, whole = 0.0;
  for (const double value : values)
    whole += value;
  for (std::size_t k = 0; k < values.size(); ++k) {
    sum += values[k];
    sums[k] = whole > 0.0 ? static_cast<float>(sum / whole)
                          : static_cast<float>(k + 1) / static_cast<float>(values.size());
  }
  sums[values.size() - 1] = 1.0F;
  return whole;
}

/// The place of u among cumulative chances: which, how far into it, and its chance.
struct Choice {
  int number;
  double within, chance;
};
Choice choose(std::span<const float> sums, double u) {
  const auto found =
      std::min(std::ranges::upper_bound(sums, static_cast<float>(u)), sums.end() - 1);
  const auto k = static_cast<std::size_t>(found - sums.begin());
  const double before = k > 0 ? double{sums[k - 1]} : 0.0, chance = double{sums[k]} - before;
  const double within = chance > 0.0 ? std::clamp((u - before) / chance, 0.0, 1.0) : 0.5;
  return {static_cast<int>(k), within, chance};
}

double chance_of(std::span<const float> sums, int number) {
  const auto k = static_cast<std::size_t>(number);
  return double{sums[k]} - (k > 0 ? double{sums[k - 1]} : 0.0);
}

std::span<const float> columns_of(const RadianceMap& map, const SkyTable& table, int row) {
  const auto width = static_cast<std::size_t>(map.width);
  return std::span(table.columns).subspan(static_cast<std::size_t>(row) * width, width);
}

/// Steradians per unit of (u, v), where the polar angle is pi v.
double stretch(double v) {
  return 2.0 * std::numbers::pi * std::numbers::pi * std::sin(std::numbers::pi * v);
}

} // namespace

SkyTable make_sky_table(const Environment& sky) {
  SkyTable table;
  if (!sky.map)
    return table;
  const RadianceMap& map = *sky.map;
  const auto width = static_cast<std::size_t>(map.width),
             height = static_cast<std::size_t>(map.height);
  table.rows.resize(height);
  table.columns.resize(width * height);
  const MeanLuminance luminance(map);
  std::vector<double> of_row(width), of_rows(height);
  for (int j = 0; j < map.height; ++j) {
    for (int i = 0; i < map.width; ++i)
      of_row[static_cast<std::size_t>(i)] = luminance(i, j);
    const auto row = static_cast<std::size_t>(j);
    of_rows[row] = texel_solid_angle(map, j) *
                   accumulate(of_row, std::span(table.columns).subspan(row * width, width));
  }
  if (!(accumulate(of_rows, table.rows) > 0.0))
    return {};
  return table;
}

SkySample sample_sky(const Environment& sky, const SkyTable& table,
                     const std::array<float, 4>& u) {
  const RadianceMap& map = *sky.map;
  const Choice row = choose(table.rows, double{u[0]});
  const Choice column = choose(columns_of(map, table, row.number), double{u[1]});
  const double v = (row.number + row.within) / map.height;
  const double at = (column.number + column.within) / map.width;
  const double solid_angle = stretch(v) / (double(map.width) * map.height);
  const double density = solid_angle > 0.0 ? row.chance * column.chance / solid_angle : 0.0;
  return {direction_at(map, at, v), density};
}

double sky_density(const Environment& sky, const SkyTable& table, const Direction& direction) {
  const RadianceMap& map = *sky.map;
  const Vec2 place = place_of(map, direction);
  const int row = std::min(static_cast<int>(place.y * map.height), map.height - 1);
  const int column = std::min(static_cast<int>(place.x * map.width), map.width - 1);
  const double solid_angle = stretch(place.y) / (double(map.width) * map.height);
  return solid_angle > 0.0 ? chance_of(table.rows, row) *
                                 chance_of(columns_of(map, table, row), column) / solid_angle
                           : 0.0;
}

} // namespace meninas::reference
