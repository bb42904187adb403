#include "runs/points/point_sets.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace meninas {

namespace {

constexpr std::size_t max_points = 1'000'000;

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Between semicolons where there are any, else between commas, else between blanks: where
/// semicolons separate, a comma may be a decimal one, and is refused as no number.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  line = trimmed(line);
  const std::string_view separators = line.find(';') != std::string_view::npos   ? ";"
                                      : line.find(',') != std::string_view::npos ? ","
                                                                                 : blanks;
  while (!line.empty()) {
    const auto end = std::min(line.find_first_of(separators), line.size());
    fields.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (separators == blanks)
      line = trimmed(line);
  }
  return fields;
}

/// Finite, in decimal digits.
std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+'))
    field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool whole = error == std::errc() && end == field.data() + field.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what) {
  throw InputError(file, fmt::format("line {}", line), what);
}

QueryPoint point_in(const std::vector<std::string_view>& fields, const std::string& file,
                    std::size_t line) {
  if (fields.size() != 3 && fields.size() != 6)
    refuse(file, line, fmt::format("{} value{}, not 3 (x, y, z) or 6 (and nx, ny, nz)",
                                   fields.size(), fields.size() == 1 ? "" : "s"));
  std::array<double, 6> values{0.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  constexpr double farthest = 1e9; // metres
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const auto value = number_in(fields[k]);
    if (!value || std::abs(*value) > farthest)
      refuse(file, line, fmt::format("value {} is no number, or a huge one", k + 1));
    values[k] = *value;
  }
  const Vec3 normal(values[3], values[4], values[5]);
  const double length = glm::length(normal);
  if (!(length > 1e-100))
    refuse(file, line, "the normal has no length");
  return {{values[0], values[1], values[2]}, normal / length};
}

} // namespace

std::vector<QueryPoint> parse_points(std::string_view text, const std::string& file) {
  std::vector<QueryPoint> points;
  bool may_be_header = true;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark))
    text.remove_prefix(byte_order_mark.size());
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto fields = fields_of(line);
    if (fields.empty() || fields.front().starts_with('#'))
      continue;
    const bool header = may_be_header && std::ranges::none_of(fields, [](std::string_view field) {
                          return number_in(field).has_value();
                        });
    may_be_header = false;
    if (header)
      continue;
    points.push_back(point_in(fields, file, number));
    if (points.size() > max_points)
      refuse(file, number, fmt::format("over {} points", max_points));
  }
  if (points.empty())
    throw InputError(file, "", "has no points");
  return points;
}

std::vector<QueryPoint> read_points(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError(file.string(), "", "no such file");
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string(), "", "not a regular file");
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 28;
  if (std::filesystem::file_size(file, error) > longest || error)
    throw InputError(file.string(), "", "is too long for a list of points");
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream)
    throw InputError(file.string(), "", "cannot be read");
  return parse_points(text, file.string());
}

std::vector<PointSet> point_sets(std::vector<QueryPoint> points, const PointRequest& request,
                                 const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<PointSet> sets;
  if (!points.empty())
    sets.push_back({"points", std::move(points), std::nullopt});
  for (const std::string& node : request.grids)
    for (MeasuringGrid& grid : measuring_grids(scene, surfaces, node, request.grid)) {
      PointSet set{grid.node, std::move(grid.points), std::nullopt};
      if (grid.face > 0)
        set.name += fmt::format(" face {}", grid.face);
      if (grid.back)
        set.name += " back";
      grid.points.clear();
      set.grid = std::move(grid);
      sets.push_back(std::move(set));
    }
  return sets;
}

} // namespace meninas
