// The elements as triangles, without cracks:
// those beside smaller ones are cut at the vertices that hang on their edges.
#pragma once

#include "radiosity/mesh/element_mesh.h"

namespace meninas {

/// A point of a region's outline (cut_cells.h) that is no vertex of the mesh: values there are
/// sum weight value(corner).
struct RegionPoint {
  Point3 position;
  ElementId element;
  std::array<float, 4> weights;
};

struct ElementTriangles {
  /// Three indices each, counter-clockwise seen from the side's own light:
  /// of vertices, and from `mesh.vertices.size()` on of points.
  std::vector<std::uint32_t> indices;
  std::vector<ElementId> elements; ///< by triangle: what it is a part of
  std::vector<RegionPoint> points;
};
ElementTriangles element_triangles(const ElementMesh& mesh);

} // namespace meninas
