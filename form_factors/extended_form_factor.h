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

#include "form_factors/point_worlds.h"
#include "form_factors/quadrature.h"

#include <string>

namespace meninas {

enum class WorldListing { worlds, totals };

struct ExtendedSettings {
  double accuracy = 1e-4;           ///< wanted error, relative to the sum of all factors asked for
  int max_depth = 1'000'000;        ///< mirrors a path may meet
  std::size_t max_points = 50'000; ///< of the integration: in a cluttered room some ten seconds
  std::size_t max_visits = 30'000'000; ///< worlds looked at from all points together
  /// Lines of shadow that are drawn to cut the senders by (discontinuity_lines.h), some tenths of a
  /// second. Where there are as many blockers senders are not cut.
  std::size_t shadow_lines = 10'000'000;
  WorldListing listing = WorldListing::worlds;
  /// By group, the brightness of what is there:
  /// the accuracy is wanted of the sum weighted by it as well. Empty: all count alike.
  std::vector<double> importance;
};

/// One mirror world's share, reflectances aside.
struct WorldFactor {
  std::vector<MirrorId> chain; ///< first mirror first; empty: the real world
  Rgb throughput{1.0};         ///< tau_w
  Estimate factor;             ///< F^w
};

struct ExtendedFactor {
  Estimate total; ///< sum_w tau_w F^w; the error holds the bound on all worlds that were left out
  Rgb light{0.0}; ///< the same by channel
  double geometric = 0.0;          ///< sum_w F^w
  std::vector<WorldFactor> worlds; ///< those with a factor, the largest tau_w F^w first
};

struct ExtendedFactors {
  std::vector<ExtendedFactor> to; ///< by group
  std::size_t points = 0;         ///< of the integration
  double tail = 0.0;              ///< bound on sum tau_w F^w over the worlds that were left out
  bool converged = true;
};

/// The largest tau_w F^w first.
void sort_worlds(ExtendedFactor& factor);

/// From all fronts `from`, weighted by area, to the groups of the view's targets.
ExtendedFactors extended_form_factors(const WorldView& view, const std::vector<Face>& from,
                                      std::size_t group_count,
                                      const ExtendedSettings& settings = {});

} // namespace meninas
