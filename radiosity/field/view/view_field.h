// The field for one view: direct light as fine as its pixels.
//
// Radiosity that is found for a view is importance-driven (Smits, Arvo, Salesin 1992): where nobody looks nothing is
// refined. Elements are divided where they are seen, each by itself (lattice_cells.h), while they are wider than
// `coarse` pixels. Cells wider than a pixel are divided while direct light D at a new vertex
// differs from the mean D_mean of the vertices it lies between by more than its noise and a share of all light H there,
//
//   abs(D - D_mean) - 2 noise  >  tolerance (H + H_dark)                   the hierarchical surplus.
//
// Within a pixel the bound is larger (view_refinement.h): cells are divided down to `finest`, so that edges end within
// pixels. In the cells where they end, the corners take the mean of D about them (cell_light.h).
//
// In a smooth place the surplus falls to a quarter with each level, at the edge of a shadow it stays: smooth light
// costs few vertices, and an edge a row of cells as small as pixels. A cell beside smaller ones is
// divided as well where the surplus on their common edge says so: an edge that is found is followed.
// D is computed past known blockers (shared_light.h); a vertex that stands for many pixels
// takes more shadow rays than one among its like.
// Indirect light is interpolated between the vertices of the mesh, which have gathered it.
//
// Shadows of punctual lights have no penumbra that tells of them from afar: each point that is seen asks for
// these lights, and a cell whose points and corners differ is divided down to half of the way between points.
//
// Limits: shadows of lamps that are narrower than coarse / 2 pixels, and far from other edges, may be missed.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/field/view/seen_cells.h"
#include "radiosity/field/view/view_refinement.h"
#include "scenes/progress.h"

#include <vector>

namespace meninas {

struct ViewField {
  IrradianceField field; ///< with cells of its own; its first values are those of the mesh
  std::uint64_t shadow_rays = 0;
};

/// Points are a pixel apart, or `apart` pixels. Precondition: the field knows its indirect part. The amount of work is
/// not known beforehand: `progress` is told 0 of "render", often, and may end it by throwing.
ViewField view_field(const IrradianceField& field, std::vector<SeenPoint> seen, double apart,
                     const ViewRefinement& how, const Progress& progress = {});

} // namespace meninas
