// Form factors world by world, and how exactly they are wanted (extended_form_factor.h).
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
  /// Steps of all points together (point_worlds.h), some 50 to 100 ns each: five seconds. Where that is few
  /// points senders are cut into fewer parts, and the result says that it has not converged.
  std::size_t max_work = 50'000'000;
  /// Lines of shadow that are drawn to cut the senders by (discontinuity_lines.h), some tenths of a
  /// second. Where there are as many blockers senders are not cut.
  std::size_t max_discontinuity_lines = 10'000'000;
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

} // namespace meninas
