// Surfaces far smaller than the elements that were asked for: a single element each, of an edge
// below a quarter of the asked one. Curved objects of many triangles consist of them.
#pragma once

#include "radiosity/mesh/element_mesh.h"

namespace meninas {

inline bool is_small(const ElementMesh& mesh, const MeshSide& side) {
  constexpr double far_smaller = 1.0 / 16.0;
  return side.element_count == 1 &&
         mesh.area[side.first_element] < far_smaller * side.element_size * side.element_size;
}

/// Whether small surfaces are more than four times as many as elements of the size asked for,
/// and more than 4,096: of fewer none need be spared.
bool is_finely_tessellated(const ElementMesh& mesh);

} // namespace meninas
