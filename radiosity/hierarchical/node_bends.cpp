#include "radiosity/hierarchical/node_bends.h"

#include "radiosity/hierarchical/node_edges.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The number of corners, of four, that have values.
std::ptrdiff_t valid_among(const ElementCorners& corners, const GatheredVertices& gathered) {
  return std::ranges::count_if(
      corners, [&](ElementVertexId corner) { return gathered.valid[index(corner)] != 0; });
}

/// Whether light is off by more than the bound allows on so large a node:
/// rho |difference| beside what is there, and a little of the mean,
/// or in the dark noise would divide as far as elements go.
bool is_beyond(const BendBound& bound, double area, const Rgb& rho, const glm::vec3& difference,
               const glm::vec3& irradiance) {
  constexpr double of_mean = 0.05;
  const double off = largest(rho * glm::abs(Rgb(difference)));
  const double there = largest(rho * Rgb(irradiance));
  return off * std::sqrt(area / bound.scale.area) >
         2.0 * bound.x * (there + of_mean * bound.scale.radiosity);
}

Rgb share_at(const ElementMesh& mesh, ElementVertexId vertex) {
  return scattered_share(mesh, index(mesh.element_of_vertex[index(vertex)]));
}

void add_parts(const NodeTree& tree, TreeNodeId id, std::vector<TreeNodeId>& parts) {
  const TreeNode& node = tree.nodes[index(id)];
  for (std::uint32_t c = 0; c < node.child_count; ++c)
    parts.push_back(static_cast<TreeNodeId>(index(node.first_child) + c));
}

/// Whether the middle of a node has light that its corners do not tell of,
/// or something stands on a part of it.
bool is_bent(const ElementMesh& mesh, const NodeTree& tree, TreeNodeId id,
             const GatheredVertices& gathered, const BendBound& bound) {
  const TreeNode& node = tree.nodes[index(id)];
  if (is_leaf(node))
    return false;
  const ElementCorners corners = corners_of(mesh, node);
  const std::ptrdiff_t valid = valid_among(corners, gathered);
  const double area = area_below(mesh, tree, id);
  return std::ranges::any_of(probes_of(mesh, tree, node), [&](const NodeProbe& probe) {
    const std::size_t p = index(probe.vertex);
    if (valid < 4 || gathered.valid[p] == 0)
      return valid > 0 || gathered.valid[p] != 0;
    glm::vec3 interpolated(0.0F);
    for (std::size_t c = 0; c < corners.size(); ++c)
      interpolated += probe.weight[c] * gathered.indirect[index(corners[c])];
    return is_beyond(bound, area, share_at(mesh, probe.vertex), gathered.indirect[p] - interpolated,
                     gathered.irradiance[p]);
  });
}

} // namespace

std::vector<TreeNodeId> parts_of_bent(const ElementMesh& mesh, const NodeTree& tree,
                                      std::span<const TreeNodeId> nodes,
                                      const GatheredVertices& gathered, const BendBound& bound,
                                      std::vector<TreeNodeId>& straight) {
  std::vector<TreeNodeId> parts;
  for (const TreeNodeId id : nodes) {
    if (is_bent(mesh, tree, id, gathered, bound))
      add_parts(tree, id, parts);
    else
      straight.push_back(id);
  }
  return parts;
}

std::vector<TreeNodeId> parts_at_bent_edges(const ElementMesh& mesh, const NodeTree& tree,
                                            const GatheredVertices& gathered,
                                            const BendBound& bound,
                                            std::vector<TreeNodeId>& straight) {
  const std::vector<MidpointStencil> crosses = crosses_of(mesh, tree, straight);
  const std::vector<glm::vec3> bends = edge_bends(crosses, gathered.valid, gathered.indirect);
  std::vector<TreeNodeId> parts, left;
  auto cross = crosses.begin();
  for (const TreeNodeId id : straight) {
    const bool is_cross = cross != crosses.end() && cross->node == id;
    const double area = area_below(mesh, tree, id);
    const bool is_bent = is_cross && std::ranges::any_of(cross->of_edges, [&](ElementVertexId v) {
                           return is_beyond(bound, area, share_at(mesh, v), bends[index(v)],
                                            gathered.irradiance[index(cross->middle)]);
                         });
    if (is_bent)
      add_parts(tree, id, parts);
    else
      left.push_back(id);
    cross += is_cross ? 1 : 0;
  }
  straight = std::move(left);
  return parts;
}

} // namespace meninas
