// The element size of each surface, metres, for a wanted number of elements.
//
// A size h for all is sqrt(A / N): N elements share the area A. A lit room on a large dark ground
// would be left with one element a wall. So a surface that has more than three quarters of all area,
// g > 3 (A - g), takes three quarters of the elements, and the others share the rest:
//
//   h = sqrt(A' / N),   A' = A - g + min(g, 3 (A - g)),   h_s = h max(1, sqrt(g / (3 (A - g)))).
//
// At most one surface is larger than that. h stays above the 256th part of sqrt(A / N):
// a lamp of a centimetre over a field does not need thousands of elements.
#pragma once

#include "radiosity/mesh/dark_sides.h"
#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas {

/// The number of sides of a patch in the mesh: those that carry radiosity and are not `dark`.
/// Ideal mirrors and clear glass have none.
unsigned meshed_sides(const Scene& scene, const SurfaceModel& surfaces, PatchId patch,
                      const DarkSides& dark = {});

/// Whether a patch of this material has sides in the mesh.
bool carries_radiosity(const Material& material);

/// By SurfaceId, the area of these sides, m^2.
std::vector<double> meshed_areas(const Scene& scene, const SurfaceModel& surfaces,
                                 const DarkSides& dark = {});

struct ElementSizes {
  double element_size = 0.0;      ///< h, metres; 0 where there is no area
  std::vector<double> of_surface; ///< by SurfaceId, h or h_s
};

/// For about so many elements.
ElementSizes share_elements(const std::vector<double>& areas, double elements);

} // namespace meninas
