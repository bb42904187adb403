#include "runs/points/point_report.h"

#include "runs/report/csv_field.h"
#include "runs/report/stats.h"
#include "scenes/errors.h"
#include "scenes/photometry.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace meninas {

namespace {

using Json = nlohmann::ordered_json;

Json rgb(const Rgb& c) { return {c.r, c.g, c.b}; }
Json xyz(const Vec3& v) { return {v.x, v.y, v.z}; }

Json point_json(const MeasuredSet& measured, std::size_t k) {
  const double efficacy = measured.luminous_efficacy;
  const QueryPoint& point = measured.set.points[k];
  const PointIrradiance& light = measured.light[k];
  Json object{{"position", xyz(point.position)},
          {"normal", xyz(point.normal)},
          {"illuminance", luminous(efficacy, light.total)},
          {"illuminance_direct", luminous(efficacy, light.direct)},
          {"illuminance_by_mirrors", luminous(efficacy, light.by_mirrors)},
          {"irradiance", rgb(light.total)},
          {"irradiance_direct", rgb(light.direct)},
          {"irradiance_by_mirrors", rgb(light.by_mirrors)}};
  for (std::size_t l = 0; l < measured.lamps.size(); ++l)
    object["illuminance_by_lamp"][measured.lamps[l]] = luminous(efficacy, light.by_lamp[l]);
  return object;
}

Json set_json(const MeasuredSet& measured) {
  Json points = Json::array();
  for (std::size_t k = 0; k < measured.light.size(); ++k)
    points.push_back(point_json(measured, k));
  const std::vector<double> lux = illuminances(measured);
  const GridSummary summary = summary_of(lux);
  Json object{{"name", measured.set.name}};
  if (const auto& grid = measured.set.grid) {
    object["node"] = grid->node;
    object["length"] = grid->length;
    object["width"] = grid->width;
    object["points_along"] = grid->along;
    object["points_across"] = grid->across;
    object["points_inside"] = measured.inside;
  }
  object["minimum"] = summary.minimum;
  object["mean"] = summary.mean;
  object["maximum"] = summary.maximum;
  object["uniformity"] = summary.uniformity;
  object["points"] = std::move(points);
  return object;
}

bool is_lit(const MeasuredSet& measured) {
  return std::ranges::any_of(measured.light,
                             [](const PointIrradiance& light) { return largest(light.total) > 0.0; });
}

bool is_json(const std::filesystem::path& file) { return file.extension() == ".json"; }

} // namespace

std::vector<double> illuminances(const MeasuredSet& measured) {
  std::vector<double> lux;
  for (const PointIrradiance& light : measured.light)
    lux.push_back(luminous(measured.luminous_efficacy, light.total));
  return lux;
}

MeasuredSet without_points_inside(MeasuredSet measured) {
  if (!measured.set.grid)
    return measured;
  MeasuredSet kept{{measured.set.name, {}, measured.set.grid}, {}, measured.luminous_efficacy, 0,
                   measured.lamps};
  for (std::size_t k = 0; k < measured.light.size(); ++k) {
    if (measured.light[k].inside)
      continue;
    kept.set.points.push_back(measured.set.points[k]);
    kept.light.push_back(measured.light[k]);
  }
  kept.inside = measured.light.size() - kept.light.size();
  // All of a dark room is no inside of anything.
  return kept.light.empty() ? measured : kept;
}

std::vector<MeasuredSet> without_dark_sides(std::vector<MeasuredSet> sets) {
  std::vector<MeasuredSet> kept;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const auto& grid = sets[k].set.grid;
    const bool has_back = k + 1 < sets.size() && sets[k + 1].set.grid && sets[k + 1].set.grid->back;
    const bool dark = !is_lit(sets[k]);
    if (dark && grid && (grid->back || (has_back && is_lit(sets[k + 1]))))
      continue;
    kept.push_back(std::move(sets[k]));
  }
  return kept;
}

std::string points_csv(std::span<const MeasuredSet> sets) {
  std::string text = "set,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,illuminance_direct_lx,"
                     "illuminance_by_mirrors_lx";
  for (const char* part : {"irradiance", "irradiance_direct", "irradiance_by_mirrors"})
    for (const char channel : {'r', 'g', 'b'})
      text += fmt::format(",{}_{}_W_m2", part, channel);
  if (!sets.empty())
    for (const std::string& lamp : sets.front().lamps)
      text += ',' + csv_field(fmt::format("illuminance_by_{}_lx", lamp));
  text += '\n';
  for (const MeasuredSet& measured : sets)
    for (std::size_t k = 0; k < measured.light.size(); ++k) {
      const auto& [x, n] = measured.set.points[k];
      const PointIrradiance& light = measured.light[k];
      text += fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", csv_field(measured.set.name),
                          x.x, x.y, x.z, n.x, n.y, n.z);
      for (const Rgb& part : {light.total, light.direct, light.by_mirrors})
        text += fmt::format(",{:.7g}", luminous(measured.luminous_efficacy, part));
      for (const Rgb& part : {light.total, light.direct, light.by_mirrors})
        text += fmt::format(",{:.7g},{:.7g},{:.7g}", part.r, part.g, part.b);
      for (std::size_t l = 0; l < measured.lamps.size(); ++l)
        text += fmt::format(",{:.7g}", luminous(measured.luminous_efficacy, light.by_lamp[l]));
      text += '\n';
    }
  return text;
}

std::string points_json(std::span<const MeasuredSet> sets) {
  Json list = Json::array();
  for (const MeasuredSet& measured : sets)
    list.push_back(set_json(measured));
  Json units{{"position", "m"}, {"length", "m"}, {"width", "m"}, {"normal", "1"}, {"luminous_efficacy", "lm/W"}};
  for (const char* key : {"illuminance", "illuminance_direct", "illuminance_by_mirrors",
                          "illuminance_by_lamp", "minimum", "mean", "maximum"})
    units[key] = "lx";
  units["uniformity"] = "1";
  for (const char* key : {"irradiance", "irradiance_direct", "irradiance_by_mirrors"})
    units[key] = "W/m^2";
  const Json object{{"units", std::move(units)},
                  {"luminous_efficacy", sets.empty() ? 0.0 : sets.front().luminous_efficacy},
                  {"sets", std::move(list)}};
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string summary_line(const MeasuredSet& measured) {
  const GridSummary summary = summary_of(illuminances(measured));
  const auto& grid = measured.set.grid;
  std::string line = fmt::format("{}{}: {} point{}", grid ? "grid " : "", measured.set.name,
                                 measured.light.size(), measured.light.size() == 1 ? "" : "s");
  if (grid)
    line += fmt::format(" {:.3g} x {:.3g} m apart", grid->length / double(grid->along),
                        grid->width / double(grid->across));
  line += fmt::format(", illuminance {:.4g} lx at least, {:.4g} lx in the mean, {:.4g} lx at most",
                      summary.minimum, summary.mean, summary.maximum);
  if (grid)
    line += fmt::format(", uniformity {:.2f}", summary.uniformity);
  if (measured.inside > 0)
    line += fmt::format(" ({} point{} inside of things left out)", measured.inside,
                        measured.inside == 1 ? "" : "s");
  return line;
}

void check_points_file(const std::filesystem::path& file) {
  if (file.extension() != ".csv" && !is_json(file))
    throw OutputError(file.string(), "", "cannot write points: their file is a .csv or a .json");
}

void write_points(const std::filesystem::path& file, std::span<const MeasuredSet> sets) {
  write_text_file(file, is_json(file) ? points_json(sets) : points_csv(sets));
}

} // namespace meninas
