// The field where light is received by nodes:
// direct light at every vertex, indirect light at the corners of nodes (node_bends.h).
//
// Indirect light is gathered twice:
// from the elements as they were solved, with a quarter of the rays,
// but not fewer than 128, and four times the bound, and then from what that makes of them,
//
//   B_j = rho_j (mean of H, by its corners and second differences; curved_means.h).
//
// Surfaces with A_surface < A / 512 skip the first gathering, since less than one of 512 rays lands on each,
// and keep the solved radiosity. The gathering matters beside the edges of large surfaces, where the
// solution is too even.
// Receivers of which nothing is seen (pass_one.h) keep the light of the first, or what they were solved to.
// In the second gathering a vertex takes the more rays the more elements it stands for
// (gather_noise.h).
//
// The solution treats a receiver as evenly lit. In a corner, where the other wall is nearer than a receiver
// is wide, that makes the corner too bright; hence the second gathering.
#pragma once

#include "radiosity/field/refine_indirect.h"
#include "radiosity/hierarchical/receiver_nodes.h"

namespace meninas {

/// Where light bends within elements these are divided, as in fields that are gathered everywhere.
/// The vertices of the receivers, which have direct light, become the field.
InterpolatedField field_by_nodes(const LightScene& light, const ElementLight& elements,
                                 HierarchicalSolution& receivers, const VertexGathering& how);

} // namespace meninas
