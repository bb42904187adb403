// The antipenumbra of two windows, one behind the other: the region seen through both.
//
// A line that crosses the first window and then the second stays,
// behind the second, on the second's side of every plane that holds the two apart.
// Such planes touch an edge of one window and a corner of the other (Teller 1992: for two convex
// polygons in front of each other these planes are all of the antipenumbra's boundary).
#pragma once

#include "mirror/convex_polygon.h"

namespace meninas {

/// The part of the polygon, which lies behind `second`, that is met by lines
/// through `first` and `second`. Exact but for windows that touch or nearly do:
/// planes that rounding decides are left out, so that the result errs on the large side.
ConvexPolygon clip_to_penumbra(const ConvexPolygon& polygon, const ConvexPolygon& first,
                               const ConvexPolygon& second);

} // namespace meninas
