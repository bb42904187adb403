// Windows: few large convex polygons instead of many small tiles.
//
// Two convex polygons that share a whole edge become one when their union is convex;
// repeated until no pair is left.
// A mirror tiled with a thousand pieces is one window, one with a hole a few.
#pragma once

#include "mirror/convex_polygon.h"

#include <vector>

namespace meninas {

/// Polygons of one plane and one orientation, disjoint;
/// corners closer than `tolerance` are the same point.
std::vector<ConvexPolygon> merge_convex(std::vector<ConvexPolygon> polygons, double tolerance);

} // namespace meninas
