// Elements divided further, each by itself: a forest of quadtrees below the leaves of the mesh,
// with vertices numbered on the lattice of each side.
//
// Corners of cells have whole coordinates, 2^24 to the edge of a root cell of the side, so that cells which
// meet in a point of one side share its vertex whatever their sizes. A cell at level l of the side is
// 2^(24 - l) wide; its corners and children are those of MeshCell (element_mesh.h, cell_children.h).
// Elements that something stands in or beside share none: what is behind it has other light.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace meninas {

/// A point of a side's lattice: (u, v) = (x / nu, y / nv) 2^-24.
struct LatticePoint {
  std::int64_t x = 0, y = 0;
};

struct LatticeVertex {
  ElementId element; ///< one of those that it is in
  LatticePoint at;
  std::uint8_t level =
      0; ///< of the cells that it was made for: one more than that whose edge it halves
  /// The vertices that it is in the middle of: the ends of an edge, each twice, or the corners of a cell.
  /// A corner of an element that halves no edge of another has none: all are itself.
  std::array<std::uint32_t, 4> between{};
};

struct LatticeCell {
  static constexpr std::uint32_t leaf = 0xffffffffU;

  ElementId element;
  LatticePoint origin; ///< corner 0
  std::uint8_t level = 0;
  bool flipped = false;
  std::array<std::uint32_t, 4> corners{}; ///< in the order of ElementCorners
  std::uint32_t first_child = leaf;
};

class LatticeCells {
public:
  static constexpr int finest = 24;
  static constexpr std::uint32_t no_vertex = 0xffffffffU;

  /// The elements as cells, in their order.
  LatticeCells(const ElementMesh& mesh, std::span<const ElementId> elements);

  const std::vector<LatticeCell>& cells() const { return cells_; }
  const std::vector<LatticeVertex>& vertices() const { return vertices_; }
  bool is_triangle(const LatticeCell& cell) const;

  /// Into four, the children in a row at the end of cells(). Precondition: a leaf above level `finest`.
  void divide(std::uint32_t cell);

  /// The vertex in the middle of the edge from one corner to the next; `no_vertex` if there is none.
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) const;

  /// The vertices in the middle of the edges of a divided cell; a triangle has no fourth, `no_vertex`.
  std::array<std::uint32_t, 4> edge_middles(const LatticeCell& divided) const;

  /// (s, t) of a vertex in its element, and (u, v) in its patch.
  Vec2 place_in_element(const LatticeVertex& vertex) const;
  Vec2 place_in_patch(const LatticeVertex& vertex) const;
  /// Whether the vertex is on the border of its patch, or of an element beside which something stands.
  bool is_at_border(const LatticeVertex& vertex) const;
  /// Whether something stands in an element, or beside it.
  bool stands_apart(ElementId element) const;

private:
  struct Key {
    std::uint64_t owner;
    std::int64_t x, y;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  Key key_of(ElementId element, LatticePoint at) const;
  std::uint32_t vertex_at(const LatticeCell& cell, LatticePoint at, std::uint8_t level,
                          const std::array<std::uint32_t, 4>* between);
  void add_corners(LatticeCell& cell);
  void halve_edges_of_roots();

  const ElementMesh& mesh_;
  std::vector<LatticeCell> cells_;
  std::vector<LatticeVertex> vertices_;
  std::unordered_map<Key, std::uint32_t, KeyHash> numbers_;
};

/// A corner of some cells in the middle of an edge of a larger one, or of a part of that edge.
/// There is no crack where its value is the mean of those at the ends.
struct HangingCorner {
  std::uint32_t vertex, end_a, end_b;
};

/// The hanging vertices on the edges of these leaves; those whose ends hang themselves come last.
std::vector<HangingCorner> hanging_corners(const LatticeCells& cells,
                                           std::vector<std::uint32_t> leaves);

} // namespace meninas
