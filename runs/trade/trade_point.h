// A point of the trade between speed and accuracy:
// settings, with what they take and what they bring.
#pragma once

#include "image/image.h"
#include "raytrace/error/picture_error.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"

#include <string>
#include <vector>

namespace meninas {

/// The change of a parameter that made a point from another.
struct ParameterChange {
  std::string parameter; ///< "rays"
  std::string from, to;
  std::size_t parent = 0; ///< index of the other point
};

struct TradePoint {
  RunSettings settings;
  std::vector<ParameterChange> turns; ///< none, of points that were there from the beginning; else one
  std::vector<double> seconds; ///< from the scene in memory to the picture, by repetition
  std::vector<double> processor_seconds; ///< of all threads
  std::vector<double> errors;            ///< against the reference (image/metrics/relative_error.h)
  PictureError estimate;                 ///< by the first repetition itself
  RunSeconds stages;                     ///< of the first repetition
  std::size_t elements = 0;
  Image picture; ///< of the first repetition
};

double mean_of(const std::vector<double>& values);
/// The largest less the smallest, over the mean.
double spread_of(const std::vector<double>& values);

/// Indices of the points than which no other is both faster and more accurate, the fastest first.
/// Equal ones: the first.
std::vector<std::size_t> pareto_front(const std::vector<TradePoint>& points);

} // namespace meninas
