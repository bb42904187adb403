// Leaves of the mesh cut along what stands on them, and the vertices of the regions that are left.
//
// A leaf that segments of contact_segments.h pass is cut by them (cut_polygon.h), as far as the run
// to which a segment belongs is long enough,
//
//   reach >= sqrt(A_leaf) / 4      (metres):
//
// leaves with smaller feet are left whole, and rays find what stands on them (contact_mask.h). Where many things that
// stand together would make more regions than light needs, longer runs alone cut:
//
//   regions <= max(4, A_leaf / (s / 4)^2),     s the size asked of elements there.
//
// Every region is an element. (Cutting along D0 edges: Heckbert 1992; Lischinski, Tampieri, Greenberg 1992.)
//
// A region keeps the corners of its leaf, between which light is interpolated as in any element.
// If a corner of the leaf lies in the region and nothing stands there, the common vertex is used.
// Otherwise the region has a separate vertex at that place, with the light next to it. Neighbouring
// regions share it if they meet on an unblocked stretch of the edge leading to the corner: so light is
// continuous along a wall and round its end, and never through it.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "radiosity/mesh/vertex_welder.h"

#include <optional>
#include <span>

namespace meninas {

/// A corner of a region: the vertex at its place that all share (`shared`),
/// or one of those that are told apart there, by number.
struct RegionCorner {
  static constexpr std::uint32_t shared = 0xffffffffU;
  std::uint32_t group = shared;
};

struct CutRegion {
  std::array<RegionCorner, 4> corners;
  RegionElement element; ///< without triangles where it is the whole leaf
};

struct CutCell {
  std::uint8_t walled_edges = 0; ///< bit k: something stands along edge k
  std::vector<CellLine> lines;   ///< counted from 0; none where there is one region
  std::vector<CutRegion> regions;
};

/// The leaves that segments touch.
struct CutCells {
  std::vector<std::uint32_t> of_cell; ///< by CellId; `uncut` where nothing touches. Empty: nowhere
  std::vector<CutCell> cells;
};

/// For the cells of a mesh, which need no elements yet, on those sides of surfaces that are `wanted`: 1 by
/// surface_side(); empty: all.
CutCells cut_leaves(const ElementMesh& mesh, const SurfaceModel& surfaces,
                    std::span<const std::uint8_t> wanted = {});

} // namespace meninas
