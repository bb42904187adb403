#include "radiosity/hierarchical/node_vertices.h"

#include <algorithm>
#include <optional>

namespace meninas {

namespace {

using Corners = std::array<Vec2, 4>;
constexpr Corners square{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
constexpr Corners half_square{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0, 1)};

const Corners& corners_of(bool triangle) { return triangle ? half_square : square; }

/// The corner of an element that is nearest to a point of it.
std::size_t nearest_corner(const ElementMesh& mesh, const ElementPoint& at) {
  const bool triangle = mesh.sides[index(mesh.side_of_element[index(at.element)])].triangle;
  const Corners& own = corners_of(triangle);
  const auto squared = [&](std::size_t c) { return glm::dot(own[c] - at.st, own[c] - at.st); };
  std::size_t nearest = 0;
  for (std::size_t c = 1; c < (triangle ? 3U : 4U); ++c)
    if (squared(c) < squared(nearest))
      nearest = c;
  return nearest;
}

/// The vertex at the corner of the node of that number: of the element there, the nearest to it.
ElementVertexId vertex_at(const ElementMesh& mesh, const TreeNode& node, std::size_t number) {
  if (is_leaf(node))
    return mesh.corners[index(node.element)][number];
  const Vec2 corner = corners_of(node.triangle)[number];
  // A point within the node, nearer to its corner than any element is wide.
  const Vec2 middle = node.triangle ? Vec2(1.0 / 3.0) : Vec2(0.5);
  constexpr double inward = 1e-7;
  const Vec2 st = corner + inward * (middle - corner);
  const ElementPoint at = locate(mesh, node.side, node.uv + st * node.extent);
  return mesh.corners[index(at.element)][nearest_corner(mesh, at)];
}

std::array<float, 4> weights_at(bool triangle, Vec2 st) {
  const auto s = static_cast<float>(st.x), t = static_cast<float>(st.y);
  if (triangle)
    return {1.0F - s - t, s, t, 0.0F};
  return {(1.0F - s) * (1.0F - t), s * (1.0F - t), s * t, (1.0F - s) * t};
}

/// The vertex nearest to the middle of a node that is no triangle, if it is within.
std::optional<NodeProbe> probe_in_the_middle(const ElementMesh& mesh, const TreeNode& node) {
  constexpr double border = 1e-6;
  const ElementPoint at = locate(mesh, node.side, node.uv + 0.5 * node.extent);
  const std::size_t corner = nearest_corner(mesh, at);
  const Vec2 uv = patch_uv_of(mesh, cell_of(mesh, at.element),
                              corners_of(mesh.sides[index(node.side)].triangle)[corner]);
  const Vec2 st = (uv - node.uv) / node.extent;
  if (std::min({st.x, st.y, 1.0 - st.x, 1.0 - st.y}) < border)
    return std::nullopt;
  return NodeProbe{mesh.corners[index(at.element)][corner], weights_at(false, st), true};
}

} // namespace

double area_below(const ElementMesh& mesh, const NodeTree& tree, TreeNodeId node) {
  double area = 0.0;
  for (const ElementId element : elements_below(tree, node))
    area += mesh.area[index(element)];
  return area;
}

ElementCorners corners_of(const ElementMesh& mesh, const TreeNode& node) {
  ElementCorners corners;
  for (std::size_t c = 0; c < corners.size(); ++c)
    corners[c] = vertex_at(mesh, node, c);
  return corners;
}

std::vector<NodeProbe> probes_of(const ElementMesh& mesh, const NodeTree& tree,
                                 const TreeNode& node) {
  constexpr double as_near = 1.0 + 1e-6;
  const Vec2 middle = node.triangle ? Vec2(1.0 / 3.0) : Vec2(0.5);
  std::vector<NodeProbe> probes;
  double nearest = 0.0;
  for (std::uint32_t k = 0; k < node.child_count; ++k) {
    const TreeNode& child = tree.nodes[index(node.first_child) + k];
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec2 corner = corners_of(child.triangle)[c];
      const Vec2 st = (child.uv + corner * child.extent - node.uv) / node.extent;
      const double distance = glm::distance(st, middle);
      if (probes.empty() || distance * as_near < nearest) {
        probes.clear();
        nearest = distance;
      } else if (distance > nearest * as_near) {
        continue;
      }
      const NodeProbe probe{vertex_at(mesh, child, c), weights_at(node.triangle, st)};
      if (std::ranges::find(probes, probe.vertex, &NodeProbe::vertex) == probes.end())
        probes.push_back(probe);
    }
  }
  if (node.child_count == 2)
    if (const auto probe = probe_in_the_middle(mesh, node))
      probes.push_back(*probe);
  return probes;
}

std::vector<double> wanted_vertices(const ElementMesh& mesh, const NodeTree& tree,
                                    std::span<const TreeNodeId> nodes) {
  std::vector<double> wanted(mesh.vertices.size(), 0.0);
  for (const TreeNodeId id : nodes) {
    const TreeNode& node = tree.nodes[index(id)];
    const double area = area_below(mesh, tree, id);
    const auto want = [&](ElementVertexId vertex) {
      wanted[index(vertex)] = std::max(wanted[index(vertex)], area);
    };
    for (const ElementVertexId corner : corners_of(mesh, node))
      want(corner);
    for (const NodeProbe& probe : probes_of(mesh, tree, node))
      want(probe.vertex);
  }
  return wanted;
}

namespace {

/// A part of a node, or a node that has none, within which vertices take from its corners.
struct Cell {
  TreeNodeId node, of;
};

/// The largest first, so that smaller ones have the last word.
std::vector<Cell> cells_of(const NodeTree& tree, std::span<const TreeNodeId> nodes) {
  std::vector<Cell> cells;
  for (const TreeNodeId id : nodes) {
    const TreeNode& node = tree.nodes[index(id)];
    for (std::uint32_t k = 0; k < node.child_count; ++k)
      cells.push_back({static_cast<TreeNodeId>(index(node.first_child) + k), id});
    if (is_leaf(node))
      cells.push_back({id, id});
  }
  std::ranges::stable_sort(cells, std::greater{}, [&](const Cell& cell) {
    return tree.nodes[index(cell.node)].leaf_count;
  });
  return cells;
}

} // namespace

InterpolationWeights vertex_shares(const ElementMesh& mesh, const NodeTree& tree,
                           std::span<const TreeNodeId> nodes) {
  InterpolationWeights shares;
  shares.from.resize(mesh.vertices.size());
  shares.weight.resize(mesh.vertices.size(), {1.0F, 0.0F, 0.0F, 0.0F});
  shares.between.assign(mesh.vertices.size(), 0);
  const std::vector<Cell> cells = cells_of(tree, nodes);
  for (const Cell& cell : cells) {
    const TreeNode& node = tree.nodes[index(cell.node)];
    const ElementCorners corners = corners_of(mesh, node);
    const Corners& in_element = corners_of(mesh.sides[index(node.side)].triangle);
    for (const ElementId element : elements_below(tree, cell.node))
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t vertex = index(mesh.corners[index(element)][c]);
        const Vec2 uv = patch_uv_of(mesh, cell_of(mesh, element), in_element[c]);
        shares.from[vertex] = corners;
        shares.weight[vertex] = weights_at(node.triangle, (uv - node.uv) / node.extent);
      }
  }
  // Corners of cells that do not gather lie between corners of the node, which do.
  for (const Cell& cell : cells) {
    const TreeNode &part = tree.nodes[index(cell.node)], &node = tree.nodes[index(cell.of)];
    const ElementCorners corners = corners_of(mesh, node), of_part = corners_of(mesh, part);
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec2 uv = part.uv + corners_of(part.triangle)[c] * part.extent;
      const std::uint32_t vertex = index(of_part[c]);
      shares.from[vertex] = corners;
      shares.weight[vertex] = weights_at(node.triangle, (uv - node.uv) / node.extent);
      shares.between[vertex] = 1;
    }
  }
  const auto keeps_its_own = [&](ElementVertexId v) {
    shares.from[index(v)].fill(v);
    shares.weight[index(v)] = {1.0F, 0.0F, 0.0F, 0.0F};
    shares.between[index(v)] = 0;
  };
  for (const TreeNodeId id : nodes) {
    const TreeNode& node = tree.nodes[index(id)];
    for (const ElementVertexId corner : corners_of(mesh, node))
      keeps_its_own(corner);
    for (const NodeProbe& probe : probes_of(mesh, tree, node))
      if (!probe.indicator_only)
        keeps_its_own(probe.vertex);
  }
  return shares;
}

} // namespace meninas
