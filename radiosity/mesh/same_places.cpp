// The cells, elements and vertices that are the same in two meshes of the same roots (subdivision.h).
#include "radiosity/mesh/subdivision.h"

#include <algorithm>

namespace meninas {

std::vector<CellId> same_cells(const ElementMesh& from, const ElementMesh& to) {
  // Parents come before their children, in either mesh; roots have the same numbers.
  std::vector<CellId> same(from.cells.size(), none<CellId>);
  for (std::uint32_t cell = 0; cell < from.cells.size(); ++cell) {
    if (from.cells[cell].parent == none<CellId>)
      same[cell] = static_cast<CellId>(cell);
    if (is_leaf(from.cells[cell]))
      continue;
    const std::uint32_t child = index(from.cells[cell].first_child),
                        other = index(to.cells[index(same[cell])].first_child);
    for (std::uint32_t k = 0; k < 4; ++k)
      same[child + k] = static_cast<CellId>(other + k);
  }
  return same;
}

std::vector<float> parts_of(const ElementMesh& from, std::span<const float> weights,
                            const ElementMesh& to) {
  std::vector<float> parts(weights.empty() ? 0 : element_count(to), 0.0F);
  if (parts.empty())
    return parts;
  const std::vector<CellId> now = same_cells(from, to);
  for (std::size_t e = 0; e < weights.size(); ++e) {
    const MeshCell& cell = to.cells[index(now[index(from.cell_of_element[e])])];
    for (float& part : std::span(parts).subspan(cell.first_element, cell.element_count))
      part = std::max(part, weights[e]);
  }
  return parts;
}

ElementCorners same_corners(const ElementMesh& from, ElementId element, const ElementMesh& to,
                            CellId id) {
  const MeshCell& was = cell_of(from, element);
  const MeshCell& is = to.cells[index(id)];
  if (is_leaf(is) && is.element_count == was.element_count)
    return to.corners[is.first_element + index(element) - was.first_element];
  const bool triangle = to.sides[index(is.side)].triangle;
  // The child that keeps a corner, and keeps its number (cell_children.h).
  constexpr std::array<std::uint32_t, 4> of_quad{0, 1, 3, 2}, of_triangle{0, 1, 2, 2};
  ElementCorners corners;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::size_t number = triangle ? std::min<std::size_t>(c, 2) : c;
    const MeshCell* cell = &is;
    while (!is_leaf(*cell))
      cell = &to.cells[index(cell->first_child) + (triangle ? of_triangle : of_quad)[c]];
    corners[c] = none<ElementVertexId>;
    const bool whole = was.element_count == 1 && cell->element_count == 1;
    const bool at_contact = is_at_contact(from, index(from.corners[index(element)][number]));
    for (std::uint32_t e = cell->first_element; e < cell->first_element + cell->element_count; ++e)
      if (whole || (!at_contact && !is_at_contact(to, index(to.corners[e][number]))))
        corners[c] = to.corners[e][number];
  }
  return corners;
}

ElementPoint place_in(const ElementMesh& coarse, const SurfaceModel& surfaces,
                      const ElementMesh& mesh, ElementVertexId vertex) {
  const Point3& x = mesh.vertices[index(vertex)];
  const ElementId element = mesh.element_of_vertex[index(vertex)];
  const SideId id = mesh.side_of_element[index(element)];
  const MeshSide& side = coarse.sides[index(id)];
  const Patch& patch = surfaces.patches[index(side.patch)];
  if (!is_at_contact(mesh, index(vertex)))
    return locate(coarse, id, uv_at(patch, x));
  Point3 within(0.0);
  if (const RegionElement* region = region_of(mesh, element)) {
    const auto& [a, b, c] = region->triangles[0];
    within = (a + b + c) / 3.0;
  } else {
    const ElementCorners& corners = mesh.corners[index(element)];
    for (std::size_t k = 0; k < 3; ++k)
      within += mesh.vertices[index(corners[k])] / 3.0;
  }
  const ElementPoint at = locate(coarse, id, uv_at(patch, within));
  const MeshCell& cell = cell_of(coarse, at.element);
  const double sign = cell.flipped ? -1.0 : 1.0;
  const Vec2 divisions(side.nu << cell.level, side.nv << cell.level);
  return {at.element,
          glm::clamp(sign * (uv_at(patch, x) * divisions - Vec2(cell.i, cell.j)), 0.0, 1.0)};
}

} // namespace meninas
