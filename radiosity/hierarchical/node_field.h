// The field where light is received by nodes:
// light from the source at every vertex, the rest at the corners of nodes (node_bends.h).
//
// The rest is gathered twice, as in adaptive fields:
// from the elements as they were solved, with a quarter of the rays,
// but not fewer than 128, and four times the bound, and then from what that makes of them,
//
//   B_j = rho_j (mean of H at its corners).
//
// Elements on which something stands, and those with a covered corner, whose value is that of the
// open, gather by themselves (open_parts.h).
//
// A receiver sends as if all of it received the same.
// Beside an edge of the room, where a wall lights the other from as near as a receiver is large,
// that is too even: corners of rooms come out too bright.
#pragma once

#include "radiosity/bent_field.h"
#include "radiosity/hierarchical/receiver_nodes.h"

namespace meninas {

/// How many times the rays that are asked for a vertex takes for the second gathering:
/// it stands for that many elements as there are to one that gathers, and the noise of its value
/// lies over all of them. N evenly spread rays leave a squared error of N^-2p (gather_noise.h), so
/// that as many rays in all do most where N goes with the area to the power of 1 / (1 + 2p) = 0.4;
/// a power of two, as nets are even then.
int times_of_rays(std::size_t elements, std::size_t receivers);

/// Where light bends within elements these are divided, as in fields that are gathered everywhere.
/// `found` has light from the source, and the values of vertices that take means of facets.
InterpolatedField field_by_nodes(const LightScene& light, const ElementLight& elements,
                                 const ReceiverNodes& receivers, const VertexGathering& how,
                                 FoundField found, PointWorkspaces& workspaces);

} // namespace meninas
