// Direct light at the vertices of a view's cells, W/m^2.
//
// Where D is smooth it is that of the vertex itself. Where an edge ends in cells that are not divided further it is the
// mean over the footprint of the vertex, w wide as the smallest cell about it (a box filter of the lattice, prefiltering):
//
//   D_v = 1/w^2 integral over abs(x - x_v) <= w/2, abs(y - y_v) <= w/2 of D(x, y) dx dy.
//
// Among cells of one size the weights of a vertex in the interpolation add up to the same w^2, so the light of the cells stays
// what it is and an edge is in its place within them. By vertices alone it would be in the middle of the cell that it crosses: off by up to w/2,
// and along an edge parallel to the lattice to the same side everywhere.
#pragma once

#include "radiosity/field/view/lattice_cells.h"
#include "radiosity/field/view/view_refinement.h"
#include "radiosity/light/shared_light.h"

namespace meninas {

/// A vertex of some cells and how much it stands for.
struct CellVertex {
  const LatticeCells& cells;
  std::uint32_t number;
};

/// At the vertex, which stands for so many pixels.
ArrivingLight direct_at(const LightScene& light, const CellVertex& vertex, double pixels,
                        const ViewRefinement& how, SharedLightWorkspace& work);

/// The mean over the footprint of the vertex, of cells of that level. Points beyond the border of the patch, or of an
/// element in which something stands, are mirrored at the vertex; the vertex stands for those that are beyond it there too.
ArrivingLight mean_direct_around(const LightScene& light, const CellVertex& vertex, int level,
                                 const ViewRefinement& how, SharedLightWorkspace& work);

} // namespace meninas
