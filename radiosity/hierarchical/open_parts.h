// Elements whose corners do not tell what arrives: a part of the element is covered,
// as of the floor's at the foot of a box, or a corner is, as behind a panel before a wall.
//
// Covered corners have no light of their own: what is continued to these from the open
// is not what arrives beside the foot or behind the panel.
// A few points of the element gather instead,
//
//   I_j = mean of I(x_k),   x_k in the part of j that is exposed (covered_cells.h),
//
// and light from the source is the mean over all of the element's points there (element_light.h).
// There are as many such elements as feet are long, few of all.
#pragma once

#include "radiosity/covered_cells.h"
#include "radiosity/found_field.h"

namespace meninas {

struct OpenPart {
  ElementId element;
  Rgb from_source, indirect; ///< D and I, W/m^2
};

/// What is known of light from the source by ElementId: 0 in `shared`, or that of corners
/// (node_light.h).
struct SourceOfElements {
  std::span<const Rgb> light;
  std::span<const std::uint8_t> shared;
};

/// Of those elements that are `asked`, by ElementId as is `covered`, and are not wholly covered.
std::vector<OpenPart> open_parts(const VertexSource& source, const SourceOfElements& known,
                                 std::span<const std::uint8_t> asked,
                                 std::span<const CoveredCells> covered);

} // namespace meninas
