// The elements and vertices that follow from the forest of cells under a mesh.
//
// A step of make_element_mesh() and divide_elements(); who uses a mesh does not need it.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "radiosity/mesh/vertex_numbers.h"

#include <span>

namespace meninas {

/// The mesh that has been divided, and by cell of the new one
/// the same cell of it: none for those that are new.
struct MeshBefore {
  const ElementMesh& mesh;
  std::span<const CellId> cells;
};

/// Numbers the leaves, depth first, and makes their corners, vertices and areas.
/// Returns the vertices by place: all of them, or of a mesh that was another before
/// those at corners of divided cells' parts and, on surfaces that have any, on the borders of patches.
/// Sides of surfaces on which no cell is new keep their elements, and what stands there does not cut them again.
/// That spares the time, and is the same mesh.
VertexNumbers add_elements(ElementMesh& mesh, const SurfaceModel& surfaces,
                           const MeshBefore* before = nullptr);

} // namespace meninas
