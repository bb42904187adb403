// Elements on a part of which something stands, as the floor's at the foot of a box.
//
// Their covered corners have no light of their own: what is continued to these from the open
// is not what arrives beside the foot. A few points of the open part gather instead,
//
//   I_j = mean of I(x_k),   x_k in the part of j that is exposed (covered_cells.h),
//
// which is what others see of them, as the mean of light from the source is.
// There are as many such elements as feet are long, few of all.
#pragma once

#include "radiosity/covered_cells.h"
#include "radiosity/found_field.h"

namespace meninas {

struct OpenPart {
  ElementId element;
  Rgb indirect; ///< I, W/m^2
};

/// Of elements that are covered in part, by ElementId.
std::vector<OpenPart> open_parts(const VertexSource& source, std::span<const CoveredCells> covered);

} // namespace meninas
