// Elements on a part of which something stands, as the floor's at the foot of a box.
//
// Their covered corners have no light of their own: what is continued to these from the open
// is not what arrives beside the foot. A few points of the open part gather instead,
//
//   H_j = mean of H(x_k),   x_k in cells of j that are not covered (covered_cells.h).
//
// There are as many such elements as feet are long, few of all.
#pragma once

#include "radiosity/covered_cells.h"
#include "radiosity/found_field.h"

#include <optional>

namespace meninas {

/// All light that arrives in the mean on the open part, W/m^2, by ElementId;
/// none of elements that are open as a whole, or where no point sees light.
std::vector<std::optional<Rgb>> light_in_open_parts(const VertexSource& source,
                                                    std::span<const CoveredCells> covered);

} // namespace meninas
