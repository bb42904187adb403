// The parameters a sweep turns, one step each:
// elements, link error, rays, form-factor method, solver and tolerance,
// mirror depth, diffuse term, interpolation, camera rays and their pixel error.
#pragma once

#include "runs/trade/trade_point.h"

#include <optional>

namespace meninas {

/// The features of a scene; parameters of features that it does not have are not turned.
struct TradeScene {
  bool mirrors = false; ///< or their depth does not matter
};

/// Settings with all numbers of the parameters spelled out: elements, rays, samples.
RunSettings spelled_out(const RunSettings& settings);

/// Where a sweep begins: a quick look, and the presets draft and normal.
std::vector<RunSettings> first_settings(const RunSettings& base);

struct ChangedSettings {
  RunSettings settings;
  ParameterChange turn; ///< its parent is left to the caller
  bool finer =
      false; ///< expected to be slower and more accurate; otherwise faster, or one cannot tell
};
/// All settings one turn away.
std::vector<ChangedSettings> turned(const RunSettings& settings, const TradeScene& scene);

} // namespace meninas
