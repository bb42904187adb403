// `diff`: how far a picture is from its reference,
// as a table for people or as JSON, as a heat map, and within limits or not.
#pragma once

#include "runs/report/comparison.h"
#include "runs/run_events.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

enum class DiffFormat { text, json };

struct DiffRequest {
  std::filesystem::path picture, reference;
  std::optional<std::filesystem::path> heat_map; ///< .png
  Metric heat_metric = Metric::flip;
  std::optional<std::string> layer;
  std::optional<double> exposure; ///< stops, for what is compared as displayed
  double relmse_epsilon = MetricSettings{}.relmse_epsilon;
  std::vector<MetricLimit> limits;
  DiffFormat format = DiffFormat::text;
};

struct DiffResult {
  std::string text;                ///< table or JSON
  std::vector<std::string> broken; ///< limits that do not hold, a line each
};

/// Writes the heat map, whether or not the limits hold.
DiffResult diff_run(const DiffRequest& request, const RunEvents& events = {});

/// {"units","rmse","relmse","mae","psnr","max_abs","width","height","ssim","flip","worst_pixel"};
/// what is infinite is null, and a unit that no file states is "not stated".
std::string diff_json(const PictureDifference& difference, const std::string& stated);

} // namespace meninas
