#include "runs/diff_run.h"

#include "image/metrics/heat_map.h"
#include "runs/outputs.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace meninas {

static void check_heat_map(const DiffRequest& request) {
  if (!request.heat_map) {
    return;
  }
  if (picture_format(*request.heat_map) != PictureFormat::png) {
    throw OutputError(request.heat_map->string(), "", "cannot write: a heat map is a .png file");
  }
  check_outputs({.pictures = {*request.heat_map}, .solution = {}, .texts = {}},
                {request.picture, request.reference});
}

static std::string value_text(const PictureDifference& difference, Metric metric,
                              const std::string& unit) {
  const double value = value_of(difference, metric);
  const std::string behind = unit_behind(metric, unit);
  switch (metric) {
  case Metric::psnr:
    return std::isinf(value) && value > 0.0 ? "infinite" : fmt::format("{:.4g}{}", value, behind);
  case Metric::max_abs:
    return value == 0.0 ? "0"
                        : fmt::format("{:.6g}{} at pixel ({}, {})", value, behind,
                                      difference.worst.x, difference.worst.y);
  default:
    return fmt::format("{:.6g}{}", value, behind);
  }
}

static std::string table(const DiffRequest& request, const PictureDifference& difference,
                         const MetricSettings& settings, const std::string& unit) {
  std::string text = fmt::format("{:<10} {}\n{:<10} {}\n", "picture", request.picture.string(),
                                 "reference", request.reference.string());
  if (request.layer) {
    text += fmt::format("{:<10} {}\n", "layer", *request.layer);
  }
  text += fmt::format("{:<10} {}x{}, ssim and flip at {:+.2f} EV\n", "size", difference.width,
                      difference.height, settings.exposure);
  if (unit.empty()) {
    text += fmt::format("{:<10} the files do not state theirs\n", "unit");
  }
  for (const Metric metric : all_metrics) {
    std::string line = fmt::format("{:<10} {}", name_of(metric), value_text(difference, metric, unit));
    for (const MetricLimit& limit : request.limits) {
      if (limit.metric == metric) {
        line = fmt::format("{:<32} {} {:.6g}{}: {}", line,
                           larger_is_nearer(metric) ? "at least" : "at most", limit.limit,
                           unit_behind(metric, unit), holds(difference, limit) ? "held" : "BROKEN");
      }
    }
    text += line + '\n';
  }
  return text;
}

std::string diff_json(const PictureDifference& difference, const std::string& stated) {
  const std::string unit = stated.empty() ? "not stated" : stated;
  const nlohmann::ordered_json units{{"rmse", unit},  {"relmse", "1"},   {"mae", unit}, {"psnr", "dB"},
                                     {"max_abs", unit}, {"ssim", "1"}, {"flip", "1"}};
  const nlohmann::ordered_json json{
      {"units", units},
      {"rmse", difference.rmse},       {"relmse", difference.relmse},
      {"mae", difference.mae},         {"psnr", difference.psnr},
      {"max_abs", difference.max_abs}, {"width", difference.width},
      {"height", difference.height},   {"ssim", difference.ssim},
      {"flip", difference.flip},       {"worst_pixel", {difference.worst.x, difference.worst.y}}};
  return json.dump(2) + '\n';
}

static void note_remarks(const ComparedPicture& picture, const std::filesystem::path& file,
                         const RunEvents& events) {
  for (const std::string& remark : picture.remarks) {
    note(events, fmt::format("{}: {}", file.string(), remark));
  }
}

DiffResult diff_run(const DiffRequest& request, const RunEvents& events) {
  check_heat_map(request);
  const ComparedPicture picture = read_compared(request.picture, request.layer);
  const ComparedPicture reference = read_compared(request.reference, request.layer);
  note_remarks(picture, request.picture, events);
  note_remarks(reference, request.reference, events);
  check_same_size(picture.image, request.picture, reference.image, request.reference);
  if (picture.encoding != reference.encoding) {
    warn(events, fmt::format("{} and {}: one holds radiance, the other a displayed picture, whose "
                             "exposure and clipping differ",
                             request.picture.string(), request.reference.string()));
  }
  if (picture.encoding == reference.encoding && !picture.unit.empty() && !reference.unit.empty() &&
      picture.unit != reference.unit) {
    warn(events, fmt::format("their units differ: {} has {}, {} has {}", request.picture.string(), picture.unit,
                             request.reference.string(), reference.unit));
  }
  MetricSettings settings = metric_settings(reference, request.exposure);
  settings.relmse_epsilon = request.relmse_epsilon;
  const PictureDifference difference = compare_pictures(picture.image, reference.image, settings);
  if (request.heat_map) {
    const Channel errors =
        error_map(difference, request.heat_metric, picture.image, reference.image, settings);
    write_png(*request.heat_map,
              heat_map(errors, heat_map_settings(difference, request.heat_metric, errors)), 0.0);
  }
  const std::string unit = unit_of_differences(picture, reference);
  return {.text = request.format == DiffFormat::json ? diff_json(difference, unit)
                                                     : table(request, difference, settings, unit),
          .broken = broken_limits(difference, request.limits, unit)};
}

} // namespace meninas
