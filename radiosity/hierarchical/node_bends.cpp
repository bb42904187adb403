#include "radiosity/hierarchical/node_bends.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// How many of the corners have values, of four.
std::ptrdiff_t valid_among(const ElementCorners& corners, const GatheredVertices& gathered) {
  return std::ranges::count_if(
      corners, [&](ElementVertexId corner) { return gathered.valid[index(corner)] != 0; });
}

/// Whether the middle of a node has light that its corners do not tell of, or something stands on a part of it.
bool is_bent(const ElementMesh& mesh, const NodeTree& tree, TreeNodeId id,
             const GatheredVertices& gathered, const BendBound& bound) {
  const TreeNode& node = tree.nodes[index(id)];
  if (is_leaf(node))
    return false;
  const ElementCorners corners = corners_of(mesh, node);
  const std::ptrdiff_t valid = valid_among(corners, gathered);
  const double weight = std::sqrt(area_below(mesh, tree, id) / bound.scale.area);
  return std::ranges::any_of(probes_of(mesh, tree, node), [&](const NodeProbe& probe) {
    const std::size_t p = index(probe.vertex);
    if (valid < 4 || gathered.valid[p] == 0)
      return valid > 0 || gathered.valid[p] != 0;
    glm::vec3 interpolated(0.0F);
    for (std::size_t c = 0; c < corners.size(); ++c)
      interpolated += probe.weight[c] * gathered.indirect[index(corners[c])];
    const Rgb& rho = mesh.reflectance[index(mesh.element_of_vertex[p])];
    const double off = largest(rho * glm::abs(Rgb(gathered.indirect[p] - interpolated)));
    const double there = largest(rho * Rgb(gathered.irradiance[p]));
    return off * weight > bound.x * (there + bound.scale.radiosity);
  });
}

} // namespace

std::vector<TreeNodeId> parts_of_bent(const ElementMesh& mesh, const NodeTree& tree,
                                      std::span<const TreeNodeId> nodes,
                                      const GatheredVertices& gathered, const BendBound& bound,
                                      std::vector<TreeNodeId>& straight) {
  std::vector<TreeNodeId> parts;
  for (const TreeNodeId id : nodes) {
    if (!is_bent(mesh, tree, id, gathered, bound)) {
      straight.push_back(id);
      continue;
    }
    const TreeNode& node = tree.nodes[index(id)];
    for (std::uint32_t c = 0; c < node.child_count; ++c)
      parts.push_back(static_cast<TreeNodeId>(index(node.first_child) + c));
  }
  return parts;
}

} // namespace meninas
