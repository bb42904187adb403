#include "radiosity/queries/node_sets.h"

namespace meninas {

std::vector<std::uint32_t> sets_of_nodes(const Scene& scene, std::span<const NodeSet> sets) {
  std::vector<std::uint32_t> result(scene.nodes.size(), none_of_sets);
  for (std::uint32_t s = 0; s < sets.size(); ++s)
    for (const NodeId node : sets[s])
      if (result[index(node)] == none_of_sets)
        result[index(node)] = s;
  return result;
}

} // namespace meninas
