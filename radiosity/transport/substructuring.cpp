#include "radiosity/transport/substructuring.h"

#include "radiosity/transport/face_clusters.h"

#include <algorithm>

namespace meninas {

namespace {

enum class Shape : std::uint8_t {
  grid,  ///< root cells [i, i + nu) x [j, j + nv); of a side of triangles, pairs of them
  wedge, ///< the triangles of nu rows from (i, j)
  cell,  ///< a cell of the forest
  region ///< that of a cut leaf whose element has the number i
};

/// A piece of a side that a node is made of.
struct Piece {
  Shape shape = Shape::grid;
  int i = 0, j = 0, nu = 1, nv = 1;
  std::uint32_t cell = 0;
};

/// The number of a root cell of a side of triangles: row j begins at j (2n - j).
std::uint32_t triangle_cell(const MeshSide& side, int i, int j, bool upper) {
  return side.first_cell +
         static_cast<std::uint32_t>(j * (2 * side.nu - j) + 2 * i + (upper ? 1 : 0));
}

/// A piece of one cell is that cell.
Piece as_cell(const MeshSide& side, Piece piece) {
  if (piece.shape == Shape::grid && !side.triangle && piece.nu == 1 && piece.nv == 1)
    return {Shape::cell, 0,
            0,           1,
            1,           side.first_cell + static_cast<std::uint32_t>(piece.j * side.nu + piece.i)};
  if (piece.shape == Shape::wedge && piece.nu == 1)
    return {Shape::cell, 0, 0, 1, 1, triangle_cell(side, piece.i, piece.j, false)};
  return piece;
}

/// Halves of a grid: in both directions unless it is much longer in one,
/// which is `aspect` times as long for every cell.
std::vector<Piece> halves(const Piece& p, double aspect) {
  constexpr double elongated = 1.5;
  const double ratio = aspect * p.nu / p.nv;
  const bool halve_u = p.nu > 1 && (ratio * elongated >= 1.0 || p.nv == 1);
  const bool halve_v = p.nv > 1 && (ratio <= elongated || p.nu == 1);
  const int half_u = halve_u ? p.nu / 2 : p.nu, half_v = halve_v ? p.nv / 2 : p.nv;
  std::vector<Piece> parts;
  for (int b = 0; b < (halve_v ? 2 : 1); ++b)
    for (int a = 0; a < (halve_u ? 2 : 1); ++a)
      parts.push_back({Shape::grid, p.i + a * half_u, p.j + b * half_v,
                       a == 0 ? half_u : p.nu - half_u, b == 0 ? half_v : p.nv - half_v});
  return parts;
}

std::vector<Piece> parts_of(const ElementMesh& mesh, const MeshSide& side, const Piece& p,
                            double aspect) {
  if (p.shape == Shape::cell && is_leaf(mesh.cells[p.cell])) {
    const MeshCell& leaf = mesh.cells[p.cell];
    std::vector<Piece> regions;
    for (std::uint32_t k = 0; k < leaf.element_count; ++k)
      regions.push_back(
          {Shape::region, static_cast<int>(leaf.first_element + k), 0, 1, 1, p.cell});
    return regions;
  }
  if (p.shape == Shape::cell) {
    const std::uint32_t first = index(mesh.cells[p.cell].first_child);
    return {{Shape::cell, 0, 0, 1, 1, first},
            {Shape::cell, 0, 0, 1, 1, first + 1},
            {Shape::cell, 0, 0, 1, 1, first + 2},
            {Shape::cell, 0, 0, 1, 1, first + 3}};
  }
  if (p.shape == Shape::wedge) {
    const int k = p.nu / 2, rest = p.nu - k;
    return {{Shape::grid, p.i, p.j, rest, k},
            {Shape::wedge, p.i, p.j + k, rest, rest},
            {Shape::wedge, p.i + rest, p.j, k, k}};
  }
  if (side.triangle && p.nu == 1 && p.nv == 1)
    return {{Shape::cell, 0, 0, 1, 1, triangle_cell(side, p.i, p.j, false)},
            {Shape::cell, 0, 0, 1, 1, triangle_cell(side, p.i, p.j, true)}};
  return halves(p, aspect);
}

TreeNode node_of(const ElementMesh& mesh, const MeshSide& side, SideId id, const Piece& p) {
  TreeNode node;
  node.side = id;
  node.triangle = side.triangle && p.shape != Shape::grid;
  if (p.shape == Shape::cell || p.shape == Shape::region) {
    const MeshCell& cell = mesh.cells[p.cell];
    node.uv = patch_uv_of(mesh, cell, Vec2(0.0));
    node.extent = patch_uv_of(mesh, cell, Vec2(1.0)) - node.uv;
    if (p.shape == Shape::region)
      node.element = static_cast<ElementId>(p.i);
    else if (is_leaf(cell) && cell.element_count == 1)
      node.element = static_cast<ElementId>(cell.first_element);
    node.cut = is_leaf(cell) && p.shape == Shape::cell && cell.element_count > 1;
  } else {
    const Vec2 cells(side.nu, side.nv);
    node.uv = Vec2(p.i, p.j) / cells;
    node.extent = Vec2(p.nu, p.nv) / cells;
  }
  return node;
}

/// Leaves are counted from below, and numbered from above: a node's come before those of the next.
void number_leaves(NodeTree& tree) {
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    TreeNode& node = tree.nodes[n];
    node.leaf_count = is_leaf(node) ? 1 : 0;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      const TreeNode& child = tree.nodes[index(node.first_child) + c];
      node.leaf_count += child.leaf_count;
      node.cut = node.cut || child.cut;
    }
  }
  std::uint32_t next = 0;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    TreeNode& node = tree.nodes[n];
    if (node.parent == none<TreeNodeId>) {
      node.first_leaf = next;
      next += node.leaf_count;
    }
    std::uint32_t first = node.first_leaf;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      TreeNode& child = tree.nodes[index(node.first_child) + c];
      child.first_leaf = first;
      first += child.leaf_count;
    }
    if (is_leaf(node))
      tree.elements[node.first_leaf] = node.element;
  }
}

/// Marks the nodes above a leaf on which something stands between this and another of its leaves.
void mark_walled(const ElementMesh& mesh, std::uint32_t number, std::size_t leaf, NodeTree& tree) {
  constexpr std::array<Vec2, 4> quad{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  constexpr std::array<Vec2, 3> half{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  const MeshCell& cell = mesh.cells[number];
  const std::span<const Vec2> corners =
      mesh.sides[index(cell.side)].triangle ? std::span<const Vec2>(half) : quad;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (((mesh.walled_edges[number] >> k) & 1U) == 0)
      continue;
    const Vec2 uv =
        patch_uv_of(mesh, cell, 0.5 * (corners[k] + corners[(k + 1) % corners.size()]));
    for (TreeNodeId above = tree.nodes[leaf].parent;
         above != none<TreeNodeId> && !is_cluster(tree.nodes[index(above)]);
         above = tree.nodes[index(above)].parent) {
      constexpr double border = 1e-9;
      TreeNode& node = tree.nodes[index(above)];
      const Vec2 st = (uv - node.uv) / node.extent;
      const double beyond = node.triangle ? 1.0 - st.x - st.y : 1.0 - std::max(st.x, st.y);
      node.cut = node.cut || std::min({st.x, st.y, beyond}) > border;
    }
  }
}

/// The aspect ratio of a root cell of the side, u over v.
double aspect_of(const MeshSide& side, const SurfaceModel& surfaces) {
  const auto& corners = surfaces.patches[index(side.patch)].corners;
  const double along_u = glm::distance(corners[0], corners[1]) / side.nu;
  const double along_v = glm::distance(corners[1], corners[2]) / side.nv;
  return side.triangle ? 1.0 : along_u / std::max(along_v, 1e-300);
}

} // namespace

NodeTree make_node_tree(const LightScene& light) {
  const ElementMesh& mesh = light.mesh;
  const SurfaceModel& surfaces = light.surfaces;
  NodeTree tree;
  tree.elements.resize(element_count(mesh));
  std::vector<Piece> pieces;
  std::vector<double> aspects; // by side
  const auto add = [&](SideId id, const Piece& piece, TreeNodeId parent) {
    const MeshSide& side = mesh.sides[index(id)];
    const Piece p = as_cell(side, piece);
    TreeNode node = node_of(mesh, side, id, p);
    node.parent = parent;
    tree.nodes.push_back(node);
    pieces.push_back(p);
  };
  const FaceClusters clusters = face_clusters(light);
  const std::size_t first_side = clusters.size();
  tree.nodes.resize(first_side);
  pieces.resize(first_side);
  const auto add_side = [&](SideId id, TreeNodeId cluster) {
    const MeshSide& side = mesh.sides[index(id)];
    const Shape shape = side.triangle ? Shape::wedge : Shape::grid;
    add(id, {shape, 0, 0, side.nu, side.nv}, cluster);
  };
  std::vector<std::uint8_t> clustered(mesh.sides.size(), 0);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    tree.nodes[c].first_child = static_cast<TreeNodeId>(tree.nodes.size());
    tree.nodes[c].child_count = static_cast<std::uint32_t>(clusters.of(c).size());
    for (const SideId id : clusters.of(c)) {
      add_side(id, TreeNodeId{c});
      clustered[index(id)] = 1;
    }
  }
  for (std::uint32_t s = 0; s < mesh.sides.size(); ++s) {
    aspects.push_back(aspect_of(mesh.sides[s], surfaces));
    if (clustered[s] == 0)
      add_side(SideId{s}, none<TreeNodeId>);
  }

  // Level by level: the children of a level make the next.
  for (std::size_t first = first_side, last = tree.nodes.size(); first < last;
       first = last, last = tree.nodes.size()) {
    for (std::size_t n = first; n < last; ++n) {
      if (tree.nodes[n].element != none<ElementId>)
        continue;
      const SideId side = tree.nodes[n].side;
      const auto parts = parts_of(mesh, mesh.sides[index(side)], pieces[n], aspects[index(side)]);
      tree.nodes[n].first_child = static_cast<TreeNodeId>(tree.nodes.size());
      tree.nodes[n].child_count = static_cast<std::uint32_t>(parts.size());
      for (const Piece& part : parts)
        add(side, part, static_cast<TreeNodeId>(n));
    }
  }
  if (!mesh.walled_edges.empty())
    for (std::size_t n = first_side; n < tree.nodes.size(); ++n)
      if (pieces[n].shape == Shape::cell && is_leaf(mesh.cells[pieces[n].cell]))
        mark_walled(mesh, pieces[n].cell, n, tree);
  number_leaves(tree);
  return tree;
}

ReceiverArea area_of(const LightScene& light, const NodeTree& tree, TreeNodeId id) {
  const TreeNode& node = tree.nodes[index(id)];
  if (is_cluster(node)) {
    ReceiverArea area;
    area.faces = elements_below(tree, id);
    return area;
  }
  if (is_leaf(node))
    return receiver_of(light, node.element);
  return part_of_side(light, light.mesh.sides[index(node.side)], node.triangle,
                      [&](Vec2 st) { return node.uv + st * node.extent; });
}

std::vector<TreeNodeId> with_faces_of_clusters(const NodeTree& tree, std::span<const TreeNodeId> nodes) {
  std::vector<TreeNodeId> faces;
  for (const TreeNodeId id : nodes) {
    const TreeNode& node = tree.nodes[index(id)];
    if (!is_cluster(node)) {
      faces.push_back(id);
      continue;
    }
    for (std::uint32_t k = 0; k < node.child_count; ++k)
      faces.push_back(static_cast<TreeNodeId>(index(node.first_child) + k));
  }
  std::ranges::sort(faces);
  return faces;
}

} // namespace meninas
