// The hemisphere of an element as one hemicube sees it:
// the row of Eq. 1 by the classic method (`hemicube`).
//
// One cube stands at the centre of the element, along its first edge,
// and what it sees counts for all of the element.
// That is a rule of one point for the mean over the element, F_ij = 1/A_i int F(x, j) dA ~ F(x_i,
// j): right for what is far away, wrong for what is near however fine the cells are, with an error
// that falls with the square of the element's size over the distance, and never where j touches i.
// The part of the element on which something stands is found as for `rays` (contact_mask.h),
// and the row speaks of the exposed rest: there the cube stands
// at the one of 64 exposed places that is nearest to the middle of all.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"

#include <optional>

namespace meninas {

/// The centre of the element or of its exposed part, metres; nothing when all is covered.
std::optional<Point3> hemicube_position(const LightScene& light, const ReceiverArea& element,
                                        ContactMask covered);

/// The directions that find what is covered: two rays and more a cell.
HemisphereSamples make_coverage_net();

/// The cells of a cube, and the directions that find what is covered (make_coverage_net()).
struct HemicubeRays {
  const Hemicube& cube;
  const HemisphereSamples& coverage;
};

/// Traces the cube; the result stands in workspace.result.
/// An element that is covered as a whole has no rays but `covered_rays`.
void gather_element(const LightScene& light, const HemicubeRays& rays, const ReceiverArea& element,
                    std::uint32_t seed, const FormFactorSettings& settings,
                    GatherWorkspace& workspace);

} // namespace meninas
