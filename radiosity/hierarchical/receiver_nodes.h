// What the solution by nodes leaves to the field that is gathered from it.
#pragma once

#include "radiosity/transport/covered_cells.h"
#include "radiosity/field/found_field.h"
#include "radiosity/transport/node_tree.h"

namespace meninas {

/// The cut at which light was received, and the vertices that lit its elements.
struct ReceiverNodes {
  NodeTree tree;
  std::vector<TreeNodeId> receivers;
  double bend = 0.0;                 ///< X (node_bends.h)
  std::vector<CoveredCells> covered; ///< by ElementId: on what something stands
  std::vector<std::uint8_t>
      share_light;     ///< by ElementId, 1: their light from the source is that of their corners
  FoundField vertices; ///< with light from the source alone (node_light.h)
};

} // namespace meninas
