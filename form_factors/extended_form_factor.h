// The form factor between faces, through mirrors and past blockers,
// to a requested accuracy (`analytic`).
//
//   F_AB = sum_w tau_w F^w_AB,    F^w_AB = 1/A_A  int_A F^w(x, B) dA     (F^w(x, B): point_worlds.h)
//
// F^w is geometric and dimensionless: reciprocity is A_A F^w_AB = A_B F^rev(w)_BA.
// The total weights each world by tau_w, the mean of the channels of the product
// of its mirrors' reflectances. Emitting, receiving: the fronts of both.
// Pairs of faces between which nothing can stand take the closed form (area_form_factor.h),
// and so do all images where mirrors are whole walls of a convex cell (kaleidoscope.h).
// The rest is integrated over A, cut where others stand on it and where shadows begin suddenly
// (discontinuity_lines.h): triangles with Radon's seven points of degree five,
// the one with the largest error split next. A triangle's error is what its factors
// changed by when its parent was split: sound for smooth parts and for kinks alike.
// Many errors are added up as in error_sum.h. Deterministic for any number of threads.
#pragma once

#include "form_factors/world_factors.h"

namespace meninas {

/// From all fronts `from`, weighted by area, to the groups of the view's targets.
ExtendedFactors extended_form_factors(const WorldView& view, const std::vector<Face>& from,
                                      std::size_t group_count,
                                      const ExtendedSettings& settings = {});

} // namespace meninas
