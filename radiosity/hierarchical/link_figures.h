// The accuracy that users ask of a hierarchical mesh, and the size of the mesh that they are told.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meninas {

struct HierarchicalSettings {
  /// X, relative to what is there: how much the light may vary over a receiver.
  /// Where vertices gather, how much what they interpolate may bend (node_bends.h);
  /// receivers, which light others by their means, then vary by 20 X.
  double link_error = 0.01;
};

struct LinkFigures {
  std::size_t receivers = 0; ///< nodes that gather
  std::size_t links = 0;     ///< between them
  std::uint64_t bytes = 0;   ///< of the tree, the rows and the links, at the end
};

} // namespace meninas
