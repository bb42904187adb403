// Groups of unknowns that shoot together in progressive radiosity (solvers/shooting.h), and the callback that
// observes the state after shots. Knows no geometry.
#pragma once

#include "scenes/types.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace meninas {

/// The groups of unknowns that shoot together, and the weight of each unknown.
struct Shooters {
  std::vector<std::uint32_t> of_unknown; ///< the shooter of each unknown
  std::vector<std::uint32_t> begin;      ///< by shooter, and one more: its first in `unknowns`
  std::vector<std::uint32_t> unknowns;
  std::vector<double> measure; ///< m, by unknown; 0: of no account

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> members(std::size_t shooter) const {
    return std::span(unknowns).subspan(begin[shooter], begin[shooter + 1] - begin[shooter]);
  }
};

/// Every unknown for itself, all of measure 1.
Shooters single_shooters(std::size_t unknowns);

/// After some shots, by unknown: B = S + rho arrived.
struct ShotsSoFar {
  int shots = 0;
  std::vector<Rgb> arrived; ///< irradiance by way of other unknowns
  std::vector<Rgb> unshot;  ///< U: what is still to be shot
};

/// Told of the state after every so many shots, and after the last.
struct ShotWatch {
  int every = 0; ///< 0: never
  std::function<void(const ShotsSoFar&)> look;
};

} // namespace meninas
