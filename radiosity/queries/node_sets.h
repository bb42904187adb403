// Sets of nodes, which form factors are asked between, and which of their sides count.
#pragma once

#include "scenes/scene.h"

#include <span>
#include <vector>

namespace meninas {

/// `facing` is above. `front` and `back` are those of A and B; `both` is all of A and B.
enum class NodeSides { facing, front, back, both };

/// Nodes that are asked for as one.
using NodeSet = std::vector<NodeId>;

/// By NodeId, the first of the sets that has the node.
inline constexpr std::uint32_t none_of_sets = 0xffffffffU;
std::vector<std::uint32_t> sets_of_nodes(const Scene& scene, std::span<const NodeSet> sets);

/// Whether a front, or a back, may count at all.
inline bool may_count(NodeSides sides, bool front) {
  return sides != (front ? NodeSides::back : NodeSides::front);
}

} // namespace meninas
