// Windows: few large convex polygons instead of many small tiles.
//
// Two convex polygons that share a whole edge become one when their union is convex, which it is if
//
//   ((v_k+1 - v_k) x (v_k+2 - v_k+1)) . n > 0   at all of its corners v_k.
//
// This is repeated until no pair is left (inessential edges: Hertel, Mehlhorn 1983). Lengths are in metres.
// A mirror tiled with a thousand pieces is one window, one with a hole a few.
#pragma once

#include "mirror/convex_polygon.h"

#include <vector>

namespace meninas {

/// Polygons of one plane and one orientation, disjoint;
/// corners closer than `tolerance` are the same point, and those so near to the line between their
/// neighbours are none. Where that leaves many polygons, as of a plate whose rows of corners are
/// not straight but for rounding, `straight` takes its place for the latter, if it is more.
std::vector<ConvexPolygon> merge_convex(std::vector<ConvexPolygon> polygons, double tolerance,
                                        double straight = 0.0);

} // namespace meninas
