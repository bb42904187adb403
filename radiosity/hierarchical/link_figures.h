// What users ask of the hierarchical solver, and what they are told of it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meninas {

struct HierarchicalSettings {
  double link_error =
      0.02; ///< how much the light may vary over a receiver, relative to what is there
};

struct LinkFigures {
  std::size_t receivers = 0; ///< nodes that gather
  std::size_t links = 0;     ///< between them
  std::uint64_t bytes = 0;   ///< of the tree, the rows and the links, at the end
};

} // namespace meninas
