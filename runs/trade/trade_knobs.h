// The knobs a sweep turns, one step each:
// elements, link error, rays, form-factor method, solver and tolerance,
// mirror depth, diffuse term, interpolation, camera rays and their pixel error.
#pragma once

#include "runs/trade/trade_point.h"

#include <optional>

namespace meninas {

/// What a sweep is about; what the scene does not have is not turned.
struct TradeScene {
  bool mirrors = false; ///< or their depth does not matter
};

/// Settings with all numbers of the knobs spelled out: elements, rays, samples.
RunSettings spelled_out(const RunSettings& settings);

/// Where a sweep begins: a quick look, and the presets draft and normal.
std::vector<RunSettings> first_settings(const RunSettings& base);

struct TurnedSettings {
  RunSettings settings;
  KnobTurn turn; ///< its parent is left to the caller
  bool finer =
      false; ///< expected to be slower and more accurate; otherwise faster, or one cannot tell
};
/// All settings one turn away.
std::vector<TurnedSettings> turned(const RunSettings& settings, const TradeScene& scene);

} // namespace meninas
