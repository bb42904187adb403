// The field where light is received by nodes:
// direct light at every vertex, the rest at the corners of nodes (node_bends.h).
//
// The rest is gathered twice:
// from the elements as they were solved, with a quarter of the rays,
// but not fewer than 128, and four times the bound, and then from what that makes of them,
//
//   B_j = rho_j (mean of H, by its corners and second differences; curved_means.h).
//
// The first is spared on surfaces so small that less than one of 512 rays lands on each: A_surface < A / 512.
// They send what they were solved to; it is beside the edges of large ones that this is too even.
// Receivers of which nothing is seen (pass_one.h) keep the light of the first, or what they were solved to.
// In the second gathering a vertex takes the more rays the more elements it stands for
// (gather_noise.h).
//
// A receiver sends as if all of it received the same.
// Beside an edge of the room, where a wall lights the other from as near as a receiver is large,
// that is too even: corners of rooms come out too bright.
#pragma once

#include "radiosity/field/refine_indirect.h"
#include "radiosity/hierarchical/receiver_nodes.h"

namespace meninas {

/// Where light bends within elements these are divided, as in fields that are gathered everywhere.
/// The vertices of the receivers, which have direct light, become the field.
InterpolatedField field_by_nodes(const LightScene& light, const ElementLight& elements,
                                 HierarchicalSolution& receivers, const VertexGathering& how);

} // namespace meninas
