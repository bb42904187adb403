// The element mesh of pass one:
// every patch side that can carry radiosity, divided in its own (u, v).
//
// A side is the front, or of a double-sided patch also the back, of a patch.
// A quad side has nu x nv root cells, cell (i, j) covers u in [i, i+1]/nu, v in [j, j+1]/nv;
// a triangle side has n rows of triangles, n = nu = nv, row j holds 2 (n - j) - 1 of them,
// lower and upper alternating. Every root cell may be divided, into four by the middles
// of its edges, and so may its quarters (subdivision.h): the mesh is a forest of quadtrees,
// its leaves are the elements. The elements of a side are numbered in a row, depth first.
// So the element of a hit (patch, u, v) is index arithmetic and a descent by halves,
// and no ray is ever traced against elements.
// Where something stands across a leaf, the leaf has an element for every region that is left
// of it (cut_cells.h): none reaches from one side of a wall to the other, and none shares a vertex
// with what is behind the wall.
// Sides of the same surface share the vertices on their common edge;
// edges that meet in one surface get the same division into roots, but beside slivers
// (edge_divisions.h).
// Ideal mirrors (no diffuse reflectance, no emission) have no side: they are not unknowns.
#pragma once

#include "radiosity/mesh/dark_sides.h"
#include "scenes/surfaces/surfaces.h"

#include <memory>
#include <vector>

namespace meninas {

struct ContactSegments; // contact_segments.h

enum class SideId : std::uint32_t {};
enum class CellId : std::uint32_t {};
enum class ElementId : std::uint32_t {};
enum class ElementVertexId : std::uint32_t {};

enum class Facing : std::uint8_t { front = 0, back = 1 };

struct MeshSettings {
  double element_size = 0.0; ///< wanted edge length in metres; 0: from `target_elements`
  double target_elements = 16000; ///< about how many, when element_size is 0 (element_sizes.h)
  std::size_t max_elements = 4'000'000; ///< a chosen size that needs more is refused (UsageError)
};

struct MeshSide {
  PatchId patch = none<PatchId>;
  Facing facing = Facing::front;
  Direction normal{0.0, 0.0, 1.0};  ///< towards the side's own light
  Direction tangent{1.0, 0.0, 0.0}; ///< along the patch's first edge: samples turn with the scene
  Plane plane;
  PlaneId plane_class = none<PlaneId>;
  MaterialId material = none<MaterialId>;
  MaterialId coat = none<MaterialId>; ///< the same, where its coat is a mirror
  NodeId node = none<NodeId>;
  double element_size = 0.0; ///< wanted edge of its roots, metres
  int nu = 1, nv = 1;
  bool triangle = false;
  std::uint32_t first_element = 0;
  std::uint32_t element_count = 0;
  std::uint32_t first_cell = 0; ///< of its root cells, which stand in a row
  std::uint32_t root_count = 0;
  bool textured = false; ///< its colours vary from point to point, or it has holes (surface_colour.h)
  Rgb reflectance{0.0};  ///< rho, diffuse, before textures
  Rgb emission{0.0};     ///< E = pi L, W/m^2, before textures
  Rgb transmittance{
      0.0}; ///< tau_d of a translucent surface, before textures: of light that its other side receives
};

/// A node of the forest: a leaf is an element, others have four children in a row.
/// At level l it covers, for (s, t) in its own [0, 1]^2 (triangles: s + t <= 1),
///   (u, v) = ((i + s) / nu 2^l, (j + t) / nv 2^l),   flipped ((i - s) / n 2^l, (j - t) / n 2^l).
struct MeshCell {
  CellId parent = none<CellId>;
  CellId first_child = none<CellId>; ///< none: a leaf
  SideId side = none<SideId>;
  std::uint32_t first_element = 0, element_count = 0; ///< those of the leaves below; of a leaf, its own: one, or its regions
  std::int32_t i = 0, j = 0;
  std::uint8_t level = 0;
  bool flipped = false; ///< a triangle that points the other way: upper ones, and the middle one of four
  double area = 0.0;    ///< m^2
};
/// Cells may be divided as often as that.
inline constexpr int max_levels = 12;

inline bool is_leaf(const MeshCell& cell) { return cell.first_child == none<CellId>; }

/// Corner vertices in the order of the cell's corners (0,0), (1,0), (1,1), (0,1);
/// a triangle repeats its third.
using ElementCorners = std::array<ElementVertexId, 4>;

/// A corner of some elements in the middle of the edge of a larger one.
/// The field has no crack there when its value is the mean of those at the ends of that edge.
struct HangingVertex {
  ElementVertexId vertex, end_a, end_b;
};

/// A line that cuts a leaf, l0 + l1 s + l2 t + l3 s t = 0 in the leaf's (s, t):
/// where that is negative `next[0]` goes on, else `next[1]`.
struct CellLine {
  static constexpr std::uint32_t region = 0x80000000U; ///< marks a region of the leaf in `next`
  std::array<double, 4> line{};
  std::array<std::uint32_t, 2> next{0, 0}; ///< in ElementMesh::lines
};

/// An element that is a region of a cut leaf.
struct RegionElement {
  std::vector<std::array<Point3, 3>> triangles; ///< that make it up
  std::vector<double> area_up_to;               ///< by triangle, m^2: its own and of all before
  Point3 centroid{0.0};
  std::array<double, 4> corner_weights{}; ///< of the bilinear value at the centroid
  std::uint8_t own_corners = 0; ///< bit c: corner c of the leaf is a corner of the region
};

struct ElementMesh {
  std::vector<MeshSide> sides;
  std::vector<std::array<SideId, 2>>
      sides_of_patch; ///< by PatchId, then Facing; none where there is no side
  std::vector<MeshCell> cells; ///< the roots of all sides, then every cell after its parent
  std::vector<CellId> cell_of_element;
  std::vector<SideId> side_of_element;
  std::vector<ElementCorners> corners;      ///< by ElementId
  std::vector<double> area;                 ///< by ElementId, m^2
  std::vector<Rgb> reflectance, emission;   ///< rho and E by ElementId, means over what is not cut out
  std::vector<Rgb>
      transmittance; ///< tau_d by ElementId, likewise; empty where there is no translucent surface
  std::vector<float> solid;                 ///< the share of an element that is not cut out
  std::vector<Point3> vertices;             ///< by ElementVertexId
  std::vector<ElementId> element_of_vertex; ///< one of the elements that share it
  std::vector<HangingVertex> hanging; ///< those whose ends hang themselves after these
  double element_size = 0.0; ///< of the roots, metres; a surface may have larger ones

  /// The contacts on the sides, by which cells are cut; null: not looked for.
  std::shared_ptr<const ContactSegments> contacts;
  std::vector<CellLine> lines;
  std::vector<std::uint32_t> line_of_cell; ///< by CellId, the first of its lines; `uncut`. Empty: nothing is cut
  std::vector<std::uint8_t> walled_edges; ///< by CellId, bit k: along edge k of the leaf a wall stands. Likewise
  std::vector<RegionElement> regions;
  std::vector<std::uint32_t> region_of_element; ///< by ElementId; `uncut`: the whole leaf. Likewise
  std::vector<std::uint8_t> at_contact; ///< by ElementVertexId: 1 where something stands at the vertex, or between it and its elements. Likewise
};
inline constexpr std::uint32_t uncut = 0xffffffffU;

/// The region that an element is; null where it is a whole leaf.
inline const RegionElement* region_of(const ElementMesh& mesh, ElementId element) {
  if (mesh.region_of_element.empty() || mesh.region_of_element[index(element)] == uncut)
    return nullptr;
  return &mesh.regions[mesh.region_of_element[index(element)]];
}
inline bool is_at_contact(const ElementMesh& mesh, std::size_t vertex) {
  return !mesh.at_contact.empty() && mesh.at_contact[vertex] != 0;
}

/// rho + tau_d: the share of light that elements scatter to either side.
inline Rgb scattered_share(const ElementMesh& mesh, std::size_t element) {
  return mesh.transmittance.empty() ? mesh.reflectance[element]
                                    : mesh.reflectance[element] + mesh.transmittance[element];
}

/// The other side of its patch where it is a translucent surface; none where that is no side.
inline SideId side_behind(const ElementMesh& mesh, SideId id) {
  const MeshSide& side = mesh.sides[index(id)];
  return side.transmittance == Rgb(0.0)
             ? none<SideId>
             : mesh.sides_of_patch[index(side.patch)][side.facing == Facing::front ? 1 : 0];
}

inline std::size_t element_count(const ElementMesh& mesh) { return mesh.area.size(); }

/// Whether any cell of the side is divided or cut.
inline bool is_divided(const MeshSide& side) { return side.element_count != side.root_count; }

/// Where in its element a point of a side is:
/// the element and (s, t) in [0, 1]^2 (for triangles s + t <= 1 from corner 0).
struct ElementPoint {
  ElementId element;
  Vec2 st;
};
ElementPoint locate(const ElementMesh& mesh, SideId side, Vec2 uv);

/// The (u, v) of its patch for the point (s, t) of a cell.
Vec2 patch_uv_of(const ElementMesh& mesh, const MeshCell& cell, Vec2 st);

inline const MeshCell& cell_of(const ElementMesh& mesh, ElementId element) {
  return mesh.cells[index(mesh.cell_of_element[index(element)])];
}

/// The wanted edge length at the element's level.
inline double size_of(const ElementMesh& mesh, ElementId element) {
  const MeshCell& cell = cell_of(mesh, element);
  return mesh.sides[index(cell.side)].element_size / static_cast<double>(1U << cell.level);
}

} // namespace meninas
