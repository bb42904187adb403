// Unoccluded pairs of faces in the real world, and their form factors in closed form (area_form_factor.h).
#pragma once

#include "form_factors/point_worlds.h"
#include "form_factors/quadrature.h"

namespace meninas {

struct ClearFormFactors {
  std::vector<std::vector<std::uint8_t>>
      known;                     ///< by sending face, then target: 1 where the closed form holds
  std::vector<Estimate> factors; ///< by group: the sum over those, weighted by the senders' areas
};

/// Errs towards "not known":
/// a blocker that no plane is found to hold apart counts as standing between.
ClearFormFactors clear_form_factors(const WorldView& view, const std::vector<Face>& from,
                                    std::size_t group_count);

} // namespace meninas
