// Form factors in a kaleidoscope, in closed form:
// faces in a convex cell, some of whose walls are mirrors all over.
//
// Where such mirrors meet each other at angles pi/n, and other walls at no more than pi/2,
// the images of the cell under all chains fill a convex part of space once (Coxeter 1934). So
// every segment from A to an image T B folds back into a path in the cell by way of mirrors alone,
// whichever chain the segment follows: the chains that share one image show all of it together,
//   sum_{w : T_w = T} F^w_AB = F(A, T B)        (area_form_factor.h)
// Rooms and ducts with mirrors for whole walls are such cells, and so are facing mirrors:
// the images of a duct are a grid, while the chains that lead there grow without bound.
// Images are visited in the order of what they may bring:
// tau F(A, wall) of the walls that lead to one bounds all that lies behind them.
#pragma once

#include "form_factors/world_factors.h"

#include <optional>

namespace meninas {

/// The convex hull of faces and mirrors, when it is such a cell.
struct KaleidoscopeCell {
  std::vector<MirrorId> walls; ///< mirrors that face the inside
  Point3 inside{0.0};     ///< a point off all walls, by whose image an image of the cell is known
  double clearance = 0.0; ///< its distance from the nearest mirror
  bool corners = false;   ///< mirrors meet: images have several chains each
};

/// Nothing when light between the faces may take other ways than the cell's images tell.
std::optional<KaleidoscopeCell> find_kaleidoscope(const WorldView& view,
                                                  const std::vector<Face>& from);

/// As extended_form_factors();
/// where mirrors meet, an image's factor stands under one of its chains. `points` are images.
ExtendedFactors kaleidoscope_form_factors(const WorldView& view, const std::vector<Face>& from,
                                          std::size_t group_count, const ExtendedSettings& settings,
                                          const KaleidoscopeCell& cell);

} // namespace meninas
