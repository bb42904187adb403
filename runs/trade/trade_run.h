// `trade`: what a second buys, for one scene and view. Settings are swept (trade_sweep.h),
// each measured for time and for error against one reference, and shown with those no other beats.
#pragma once

#include "runs/run_events.h"
#include "runs/run_settings.h"

#include <filesystem>
#include <optional>
#include <string>

namespace meninas {

struct TradeRequest {
  std::filesystem::path scene;
  std::filesystem::path folder; ///< made if it is not there
  std::optional<std::filesystem::path>
      reference;        ///< a picture of this view, linear; else one is path-traced
  double budget = 60.0; ///< seconds, the reference included
  std::optional<std::string> camera;
  std::optional<PictureSize> size; ///< that of the reference where there is one; else 256 rows
  RunSettings settings;            ///< background, threads and seed are heeded
};

/// Writes trade.json, trade.csv and last index.html into the folder.
/// Throws a UserError; every file that is there is whole.
void trade_run(const TradeRequest& request, const RunEvents& events = {});

} // namespace meninas
