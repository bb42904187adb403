// An upper bound of the light from beyond the tree of mirror worlds.
//
// Worlds that are not in the tree (`cut`, mirror/worlds.h) and all that lie behind them are seen
// through the windows of the cut ones. In the hemisphere of an element i, a cut world w = (m1 ...
// mk) takes at most the form factor of its last window, seen through the first:
//
//   1/A sum_i A_i sum_cut tau_w F_i(window_k through window_1)  <=  1/A sum_cut tau_w A(window_1) F(window_1, window_k)
//
// for every line through window_1 starts on one element only,
// and what is behind m_k brings no more than tau_w. A is the area of the elements.
// This bounds the mean, over the elements, of the share of light that arrives from beyond the tree.
// It is finite, and falls like 1/k^2, also between facing mirrors of reflectance 1.
//
// That light is not lost: the rays of the form factors follow it.
// A ray loses the rest of its light when its throughput falls below `min_throughput`
// or its bounces exceed `max_bounces` (form_factors.h): closure.cut, as measured.
#pragma once

#include "mirror/worlds.h"

namespace meninas {

/// The bound above, at most 1; `area` in m^2 of all that receives light.
double mirror_depth_bound(const WorldTree& tree, const MirrorSet& mirrors, double area);

/// Area of the fronts (and backs, where double-sided) that are no ideal mirrors.
double receiving_area(const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
