// Clusters of connected faces, each far smaller than an element and all facing nearly one way.
//
// Curved furniture comes as thousands of facets that receive nearly the same indirect light: a cluster
// receives it once for all of its faces (transport/substructuring.h), so the cost of a row is that of
// what the light needs and not of what the file is made of.
// Face cluster radiosity: Willmott, Heckbert and Garland 1999. Here a cluster grows from its first
// face over common corners, while
//
//   n . n_first >= cos 25 degrees,     sum of A <= (s / 4)^2,     at most 32 faces
//
// with s the size asked of elements there, and over faces whose middles see, with that of the first one,
// a point above the curve between them: what stands between two faces parts their light.
// Faces are taken by their numbers, so that clusters turn and
// scale with the scene. Linear in faces.
#pragma once

#include "radiosity/scene/light_scene.h"

#include <span>

namespace meninas {

/// Disjoint sets of at least two sides of one element each.
struct FaceClusters {
  std::vector<std::uint32_t> begin{0}; ///< by cluster, and the end
  std::vector<SideId> sides;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const SideId> of(std::size_t cluster) const {
    return std::span(sides).subspan(begin[cluster], begin[cluster + 1] - begin[cluster]);
  }
};

/// None in meshes that are not finely tessellated (small_surfaces.h), and none of faces below a coat
/// that is a mirror, whose rays leave with a share of their light by their own normal.
FaceClusters face_clusters(const LightScene& light);

} // namespace meninas
