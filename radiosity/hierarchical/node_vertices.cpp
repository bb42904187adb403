#include "radiosity/hierarchical/node_vertices.h"

#include <algorithm>
#include <numeric>

namespace meninas {

namespace {

using Corners = std::array<Vec2, 4>;
constexpr Corners square{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
constexpr Corners half_square{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0, 1)};

const Corners& corners_of(bool triangle) { return triangle ? half_square : square; }

/// The element at a corner of the node, and which corner of the element that is.
ElementVertexId vertex_at(const ElementMesh& mesh, const TreeNode& node, Vec2 corner) {
  // A point within the node, nearer to its corner than any element is wide.
  const Vec2 middle = node.triangle ? Vec2(1.0 / 3.0) : Vec2(0.5);
  constexpr double inward = 1e-7;
  const Vec2 st = corner + inward * (middle - corner);
  const ElementPoint at = locate(mesh, node.side, node.uv + st * node.extent);
  const bool triangle = mesh.sides[index(node.side)].triangle;
  const Corners& own = corners_of(triangle);
  std::size_t nearest = 0;
  for (std::size_t c = 1; c < (triangle ? 3U : 4U); ++c)
    if (glm::distance(own[c], at.st) < glm::distance(own[nearest], at.st))
      nearest = c;
  return mesh.corners[index(at.element)][nearest];
}

std::array<float, 4> weights_at(bool triangle, Vec2 st) {
  const auto s = static_cast<float>(st.x), t = static_cast<float>(st.y);
  if (triangle)
    return {1.0F - s - t, s, t, 0.0F};
  return {(1.0F - s) * (1.0F - t), s * (1.0F - t), s * t, (1.0F - s) * t};
}

} // namespace

VertexShares vertex_shares(const ElementMesh& mesh, const NodeTree& tree, const NodeCut& cut) {
  // Larger receivers first, so that smaller ones have the last word, and corners after all.
  std::vector<std::uint32_t> order(cut.receivers.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto size = [&](std::uint32_t r) { return tree.nodes[index(cut.receivers[r])].leaf_count; };
  std::ranges::stable_sort(order, std::greater{}, size);

  VertexShares shares;
  shares.from.resize(mesh.vertices.size());
  shares.weight.resize(mesh.vertices.size(), {1.0F, 0.0F, 0.0F, 0.0F});
  std::vector<std::array<ElementVertexId, 4>> corners(cut.receivers.size());
  for (const std::uint32_t r : order) {
    const TreeNode& node = tree.nodes[index(cut.receivers[r])];
    const Corners& places = corners_of(node.triangle);
    for (std::size_t c = 0; c < 4; ++c)
      corners[r][c] = vertex_at(mesh, node, places[c]);
    const Corners& in_element = corners_of(mesh.sides[index(node.side)].triangle);
    for (const ElementId element : elements_below(tree, cut.receivers[r]))
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t vertex = index(mesh.corners[index(element)][c]);
        const Vec2 uv = patch_uv_of(mesh, cell_of(mesh, element), in_element[c]);
        shares.from[vertex] = corners[r];
        shares.weight[vertex] = weights_at(node.triangle, (uv - node.uv) / node.extent);
      }
  }
  for (const auto& of_receiver : corners)
    for (const ElementVertexId vertex : of_receiver) {
      shares.from[index(vertex)].fill(vertex);
      shares.weight[index(vertex)] = {1.0F, 0.0F, 0.0F, 0.0F};
    }
  return shares;
}

} // namespace meninas
