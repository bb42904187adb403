// Facets on which edges of light are to be seen.
//
// A vertex of facets takes the mean of what these receive (smoothing_groups.h), which is smooth over a curve.
// This mean hides two things. (1) A shadow on one facet spreads to its neighbours. A shadow ends on a
// facet if the visible part V of the source differs between its corners:
//
//   V = D / D unblocked,   max V - min V > 1/10.
//
// (2) The edge between two facets disappears. Facets that meet at more than 15 degrees are visible as
// facets, so they are not smoothed. Both get direct light of their own where the means bend by more than the bound
// (refine_direct.h). V depends on occlusion only, so fully lit curved surfaces stay smooth.
// Limit: the shadows of punctual lights, and of light by way of solids of glass, are not looked for.
#pragma once

#include "radiosity/field/final_gathering.h"

namespace meninas {

/// Facets that meet at a larger angle (degrees) are not smoothed.
inline constexpr double max_smooth_turn = 15.0;

/// The facets, among these elements with averaged corners, on which a shadow ends or which meet their
/// neighbours at more than max_smooth_turn.
/// `level` tells samples apart, as in light_vertices().
std::vector<ElementId> faces_with_shadow_edges(const LightScene& light, const VertexSource& source,
                                         std::uint32_t level, const VertexSamples& found,
                                         std::span<const ElementId> facets);

} // namespace meninas
