#include "radiosity/mesh/element_mesh.h"

#include "radiosity/mesh/cell_children.h"

#include <algorithm>

namespace meninas {

namespace {

/// A cell by its number, and where in it a point is.
struct CellPoint {
  std::uint32_t cell;
  Vec2 st;
};

bool is_beyond(const std::array<double, 4>& line, Vec2 st) {
  return line[0] + line[1] * st.x + line[2] * st.y + line[3] * st.x * st.y >= 0.0;
}

CellPoint locate_root(const MeshSide& side, Vec2 uv) {
  const double fu = within_unit(uv.x) * side.nu;
  const double fv = within_unit(uv.y) * side.nv;
  if (!side.triangle) {
    const int i = std::min(static_cast<int>(fu), side.nu - 1);
    const int j = std::min(static_cast<int>(fv), side.nv - 1);
    return {side.first_cell + static_cast<std::uint32_t>(j * side.nu + i), {fu - i, fv - j}};
  }

  // Row j holds 2 (n - j) - 1 triangles, so it starts at j (2n - j);
  // beyond the diagonal of its cell a point is in the upper one.
  const int n = side.nu;
  const int j = std::min(static_cast<int>(fv), n - 1);
  const int i = std::min(static_cast<int>(fu), n - 1 - j);
  const double s = fu - i, t = fv - j;
  const bool upper = s + t > 1.0 && i + j < n - 1;
  const auto local = static_cast<std::uint32_t>(j * (2 * n - j) + 2 * i + (upper ? 1 : 0));
  return {side.first_cell + local, upper ? Vec2(1.0 - s, 1.0 - t) : Vec2(s, t)};
}

} // namespace

ElementPoint locate(const ElementMesh& mesh, SideId id, Vec2 uv) {
  const MeshSide& side = mesh.sides[index(id)];
  CellPoint at = locate_root(side, uv);
  while (!is_leaf(mesh.cells[at.cell])) {
    const ChildPoint<Vec2> child = child_at(at.st, side.triangle);
    at = {index(mesh.cells[at.cell].first_child) + child.child, child.st};
  }
  std::uint32_t element = mesh.cells[at.cell].first_element;
  if (!mesh.line_of_cell.empty() && mesh.line_of_cell[at.cell] != uncut) {
    std::uint32_t next = mesh.line_of_cell[at.cell];
    while ((next & CellLine::region) == 0)
      next = mesh.lines[next].next[is_beyond(mesh.lines[next].line, at.st) ? 1 : 0];
    element += next & ~CellLine::region;
  }
  return {static_cast<ElementId>(element), at.st};
}

Vec2 patch_uv_of(const ElementMesh& mesh, const MeshCell& cell, Vec2 st) {
  const MeshSide& side = mesh.sides[index(cell.side)];
  const double sign = cell.flipped ? -1.0 : 1.0;
  return {(cell.i + sign * st.x) / (side.nu << cell.level),
          (cell.j + sign * st.y) / (side.nv << cell.level)};
}

} // namespace meninas
