// Light from the source where elements only light others:
// they have it from nodes, about as many however fine the elements are.
//
//   D_j = D_n,   n the largest node above element j with at most 2/N of all elements,   D_n the mean over n (element_light.h)
//
// What such elements light takes the mean over many of them,
// so that what counts is how many points there are in all:
// N of them, or twice as many, are shared out among the nodes. Their means are noisy, but true.
// Elements of which something covers a part, whose corners do not tell (open_parts.h),
// and facets of curved surfaces, whose means are seen (facets.h), are nodes by themselves
// and have all of their points. So have nodes of groups, a 512th of all elements,
// at which more than a 256th of all light arrives, or that reflect as much of what is:
// a spot of the sun is some tens of elements, and all light comes from there,
// and a black shade around a lamp absorbs more than corners of its elements tell.
// There are at most 512 such groups, of some tens of nodes.
#pragma once

#include "radiosity/element_light.h"
#include "radiosity/hierarchical/node_tree.h"

namespace meninas {

/// N, points in all.
inline constexpr int points_of_sources = 8192;

/// The settings for each of so many nodes, of N points.
DirectSettings shared_out(DirectSettings settings, std::size_t nodes);

/// Of so many elements, the most that a node has.
std::uint32_t most_lit_together(std::size_t elements);

/// A cut through the tree: nodes of at most that many elements,
/// none of them by itself, and those that are. `alone` by ElementId.
std::vector<TreeNodeId> nodes_lit_together(const NodeTree& tree, std::uint32_t most_elements,
                                           std::span<const std::uint8_t> alone);

/// By ElementId. `covered` likewise: on what something stands.
DirectIrradiance light_by_nodes(const LightScene& light, const NodeTree& tree,
                                std::span<const CoveredCells> covered,
                                const DirectSettings& settings, const Progress& progress);

/// Elements that may have had their light together with one of these, and these.
std::vector<ElementId> lit_with(const NodeTree& tree, std::span<const ElementId> elements);

/// Light of some elements anew, each by itself with all points: of others nothing has changed.
void light_again(const LightScene& light, std::span<const ElementId> elements,
                 std::span<const CoveredCells> covered, const DirectSettings& settings,
                 const Progress& progress, DirectIrradiance& direct);

} // namespace meninas
