// The result of the hierarchical solution from which the field is gathered.
#pragma once

#include "radiosity/transport/contact_mask.h"
#include "radiosity/field/final_gathering.h"
#include "radiosity/transport/substructuring.h"

namespace meninas {

/// The cut at which light was received, and the vertices that lit its elements.
struct HierarchicalSolution {
  NodeTree tree;
  std::vector<TreeNodeId> receivers; ///< the faces of clusters in place of these
  double bend = 0.0;                 ///< X (node_bends.h)
  std::vector<ContactMask> covered; ///< by ElementId: on what something stands
  std::vector<std::uint8_t>
      share_light;     ///< by ElementId, 1: their direct light is that of their corners
  std::vector<std::uint8_t> clustered; ///< by ElementId, 1: it received as one of a cluster of faces
  VertexSamples vertices; ///< with direct light alone (node_light.h)
};

} // namespace meninas
