// Grids of measuring points on the faces of a node, as EN 12464-1:2011, 4.4 spaces them:
//
//   p = 0.2 * 5^log10(d)      metres, at most 10
//
// between points, with d the longer side of the area in metres, or the shorter one where the longer is
// twice as long or more. Along d there are round(d / p) points, at least one, and so many along the other
// side that cells come nearest to squares. The area is the smallest rectangle around a face, less the
// margin; points stand in the middle of cells, and those that are not over the face are left out.
#pragma once

#include "radiosity/queries/point_light.h"

#include <string>

namespace meninas {

struct GridSettings {
  double margin = 0.0; ///< left out along each side of the rectangle, metres
  double height = 0.0; ///< of the points above the face, metres
};

struct MeasuringGrid {
  std::string node = {};
  std::size_t face = 0; ///< of the node's, counted from 1; 0: it has but one
  bool back = false;    ///< of a face that has two sides
  double length = 0.0, width = 0.0; ///< of the rectangle within the margin, the longer side first, metres
  std::size_t along = 0, across = 0; ///< points in these directions
  std::vector<QueryPoint> points = {};
};

/// p of a rectangle, metres.
double grid_spacing(double length, double width);

/// A grid on the front of each face of the node, and after it one on the back where that is a side too.
/// Throws UsageError for a node that is none, that has over 64 faces, and where the margin leaves nothing.
std::vector<MeasuringGrid> measuring_grids(const Scene& scene, const SurfaceModel& surfaces,
                                           const std::string& node, const GridSettings& settings);

/// A summary of the illuminance, or any other value, of a grid's points.
struct GridSummary {
  double minimum = 0.0, mean = 0.0, maximum = 0.0;
  double uniformity = 0.0; ///< U0 = minimum / mean; 0 where all is dark
};
GridSummary summary_of(std::span<const double> values);

} // namespace meninas
