// The element mesh of pass one: every patch side that can carry radiosity, divided in its own (u, v).
//
// A side is the front, or of a double-sided patch also the back, of a patch. A quad side has nu x nv elements, element (i, j) covers
// u in [i, i+1]/nu, v in [j, j+1]/nv; a triangle side has n rows of triangles, n = nu = nv, row j holds 2 (n - j) - 1 of them, lower
// and upper alternating. So the element of a hit (patch, u, v) is index arithmetic, and no ray is ever traced against elements.
// Sides of the same surface share the vertices on their common edge; edges that meet in one surface get the same division.
// Ideal mirrors (no diffuse reflectance, no emission) have no side: they are not unknowns.
#pragma once

#include "radiosity/dark_sides.h"
#include "scenes/surfaces.h"

#include <vector>

namespace meninas {

enum class SideId : std::uint32_t {};
enum class ElementId : std::uint32_t {};
enum class ElementVertexId : std::uint32_t {};

enum class Facing : std::uint8_t { front = 0, back = 1 };

struct MeshSettings {
  double element_size = 0.0; ///< wanted edge length in metres; 0: from `target_elements`
  double target_elements =
      16000; ///< about how many elements share the meshed area when element_size is 0
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
  NodeId node = none<NodeId>;
  int nu = 1, nv = 1;
  bool triangle = false;
  std::uint32_t first_element = 0;
  std::uint32_t element_count = 0;
  Rgb reflectance{0.0}; ///< rho, diffuse
  Rgb emission{0.0};    ///< E = pi L, W/m^2
};

/// Corner vertices in the order of the cell's corners (0,0), (1,0), (1,1), (0,1); a triangle repeats its third.
using ElementCorners = std::array<ElementVertexId, 4>;

struct ElementMesh {
  std::vector<MeshSide> sides;
  std::vector<std::array<SideId, 2>>
      sides_of_patch; ///< by PatchId, then Facing; none where there is no side
  std::vector<SideId> side_of_element;
  std::vector<ElementCorners> corners;      ///< by ElementId
  std::vector<double> area;                 ///< by ElementId, m^2
  std::vector<Point3> vertices;             ///< by ElementVertexId
  std::vector<ElementId> element_of_vertex; ///< one of the elements that share it
  double element_size = 0.0;                ///< what was used, metres
};

/// Sides marked in `dark` get no elements; empty: all are meshed.
ElementMesh make_element_mesh(const Scene& scene, const SurfaceModel& surfaces,
                              const MeshSettings& settings = {}, const DarkSides& dark = {});

inline std::size_t element_count(const ElementMesh& mesh) { return mesh.area.size(); }

/// Where in its element a point of a side is: the element and (s, t) in [0, 1]^2 (for triangles s + t <= 1 from corner 0).
struct ElementPoint {
  ElementId element;
  Vec2 st;
};
ElementPoint locate(const MeshSide& side, Vec2 uv);

/// The (u, v) of its patch for the point (s, t) of an element; `local_element` counts from the side's first.
Vec2 patch_uv_of(const MeshSide& side, std::uint32_t local_element, Vec2 st);

} // namespace meninas
