// The sweep over settings within a budget of seconds.
//
// First a quick look and the presets that fit, then every parameter one turn from the draft,
// as far as half of the budget goes. The rest goes to the widest gap between neighbours of the Pareto front
// (log seconds, log error): refine one parameter of its faster end or coarsen one of its slower end, starting
// with the parameter behind the largest part of the estimated error. The open end counts as a gap.
// The last fifth of the budget repeats the points of the front with other seeds, because a single
// measurement is a matter of luck.
#pragma once

#include "runs/trade/trade_parameters.h"

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
