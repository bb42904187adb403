// Which settings a budget is spent on.
//
// First a quick look and the presets that fit, then every knob one turn from the draft,
// as far as half of the budget goes. Then the budget goes where the front is uncertain:
// the widest gap between neighbours of the front, in the logarithms of seconds and error,
// is looked into with turns of the knobs of its ends, finer ones of the faster, coarser ones
// of the slower, first those of the largest part of the error by the pictures' own estimates;
// the open end, more accurate than all so far, counts as a gap as well.
// Its last fifth repeats the points of the front with other seeds:
// what is measured once is a matter of luck.
#pragma once

#include "runs/trade/trade_knobs.h"

#include <functional>

namespace meninas {

/// Measures a point's settings once more and adds what it finds; with another seed each time.
using MeasurePoint = std::function<void(TradePoint&)>;

struct SweepSettings {
  double budget = 60.0;          ///< seconds
  std::function<double()> spent; ///< of them so far
  std::function<void(const std::string&, double)>
      progress; ///< what is measured, fraction of the budget
};

/// All points measured, in the order they were. At least one is, whatever the budget.
std::vector<TradePoint> sweep(const RunSettings& base, const TradeScene& scene,
                              const MeasurePoint& measure, const SweepSettings& settings);

} // namespace meninas
