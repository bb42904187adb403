// The cut through the tree of nodes at which light is received, and what the nodes on it gather.
//
// A receiver is a node that gathers for all elements below it: one row of form factors
// (form_factors.h, `rays` from points all over the node) instead of one for each element.
// Every element has exactly one receiver, itself or a node above it.
// So rows are as many as the light asks for, however fine the elements are.
// Rows are kept when the cut moves down: only nodes that are new to it are traced.
//
// The rays of a row also find objects standing on the node (contact_mask.h). A partly covered node is
// divided until each part is free, fully covered or an element. A node whose rays meet black backs is
// divided until it has few elements, because the object may be small.
#pragma once

#include "radiosity/transport/substructuring.h"

namespace meninas {

/// Receivers in the order of their numbers in the tree, and what they have gathered.
struct NodeCut {
  std::vector<TreeNodeId> receivers;
  std::vector<std::uint32_t> receiver_of_element; ///< by ElementId: its place in `receivers`
  Transport rows;                                 ///< by receiver; columns are elements
  std::vector<RowClosure> closure;                ///< by receiver
  std::vector<Rgb> emission;                      ///< by receiver: gathered_emission.h, W/m^2
  std::vector<std::vector<double>> emission_by_lamp; ///< likewise, a row of LightByLamp each; empty where light is not told apart
  std::vector<ContactMask> covered;              ///< by receiver, of itself
  std::vector<float> exposed;                     ///< by receiver: the share of it on which nothing stands
  std::uint64_t rays_traced = 0;                  ///< for all nodes that have ever been receivers
};

/// By ElementId: the cells on which something stands.
std::vector<ContactMask> covered_elements(const NodeTree& tree, const NodeCut& cut);

/// By ElementId, 1: it receives as one of a cluster of faces.
std::vector<std::uint8_t> clustered_elements(const NodeTree& tree, const NodeCut& cut);

/// By ElementId: the share of its area that is there and on which nothing stands.
std::vector<float> exposed_shares(const ElementMesh& mesh, const NodeTree& tree,
                                  const NodeCut& cut);

/// Clusters of faces, and of other sides four to sixteen nodes on every one that has so many elements:
/// one for each 1/1024 of all there is. Where something stands across one, its parts.
std::vector<TreeNodeId> first_receivers(const ElementMesh& mesh, const NodeTree& tree);

/// The cut at the first receivers, and at smaller ones where something stands on a side.
NodeCut first_cut(const LightScene& light, const NodeTree& tree, const FormFactorSettings& settings,
                  const Progress& progress);

/// Receivers that are marked, by their place, give way to their children. Elements cannot.
NodeCut moved_down(const LightScene& light, const NodeTree& tree, NodeCut cut,
                   const std::vector<std::uint8_t>& marked, const FormFactorSettings& settings,
                   const Progress& progress);

/// The same receivers with rows of other rays. Rays choose which receivers are divided: where few find the bright
/// spot that lights all, receivers whose rays do are divided and traced again, those whose rays miss it are not,
/// and light would be lost. Rows that had no say in it are right in the mean.
NodeCut traced_anew(const LightScene& light, const NodeTree& tree, NodeCut cut,
                    FormFactorSettings settings, const Progress& progress);

/// The means over the elements below every receiver, X_c = sum A_j X_j / sum A_j. `areas` (m^2) and values by ElementId.
std::vector<Rgb> means_below(const NodeTree& tree, const NodeCut& cut,
                             const std::vector<double>& areas, const std::vector<Rgb>& values);

/// The transport between receivers: F_cd is the sum of F_cj over the elements j below d.
Transport between_receivers(const NodeCut& cut);

} // namespace meninas
