// Elements on a part of which something stands, as the floor's at the foot of a box.
//
// Their covered corners have no light of their own: what is continued to these from the open
// is not what arrives beside the foot. A few points of the open part gather instead,
//
//   I_j = mean of I(x_k),   x_k not shut in, in cells of j that are not covered (covered_cells.h),
//
// and of so many the share q_j that is not is open: a foot goes through cells.
// What arrives from the source is known for all of these cells as a mean D_j, so that
//
//   H_j = D_j + q_j I_j,   B_j = rho_j (D_j / q_j + I_j),
//
// the mean over the cells, of which energy is counted, and what is seen, of the open alone.
// With q = 0, where no point is found open, B is of the mean as well.
// q is off by up to 0.5 / sqrt(32) = 9 %.
// There are as many such elements as feet are long, few of all.
#pragma once

#include "radiosity/covered_cells.h"
#include "radiosity/found_field.h"

namespace meninas {

struct OpenPart {
  ElementId element;
  double share; ///< q
  Rgb indirect; ///< I, W/m^2
};

/// Of elements that are covered in part, by ElementId.
std::vector<OpenPart> open_parts(const VertexSource& source, std::span<const CoveredCells> covered);

} // namespace meninas
