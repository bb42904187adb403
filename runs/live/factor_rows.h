// The form factors of an element of the page, for who points at it:
//
//   F_ij = F^0_ij + sum over w > 0 of tau_w F^w_ij      (radiosity/queries/element_factors.h), dimensionless
//
// as halves h times a scale, F = scale h, by element of the page: in two columns, those without a mirror on the way
// and those by mirrors.
#pragma once

#include "runs/live/live_board.h"

namespace meninas {

/// Rays to a row, where it is by rays: so many that it can be looked at on any mesh.
inline constexpr int rays_of_shown_row = 1 << 17;

/// Answers calls of any thread, one at a time.
class FactorRows {
public:
  /// As joined_message(). Throws UserError, a sentence, where the page has no such element, or it has no factors.
  std::string row(const ShownMesh& mesh, std::size_t page_element);

private:
  std::mutex mutex_;
};

} // namespace meninas
