#include "radiosity/mesh/mesh_cells.h"

#include <algorithm>

namespace meninas {

double longest_edge(const ElementMesh& mesh, const ElementCorners& corners) {
  double longest = 0.0;
  for (std::size_t c = 0; c < 4; ++c)
    longest = std::max(longest, glm::distance(mesh.vertices[index(corners[c])],
                                              mesh.vertices[index(corners[(c + 1) % 4])]));
  return longest;
}

Point3 point_in(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshCell& cell,
                Vec2 st) {
  return point_at(surfaces.patches[index(mesh.sides[index(cell.side)].patch)],
                  patch_uv_of(mesh, cell, st));
}

std::uint64_t surface_side(const ElementMesh& mesh, const SurfaceModel& surfaces,
                           const MeshCell& cell) {
  const MeshSide& side = mesh.sides[index(cell.side)];
  return 2ULL * index(surfaces.patches[index(side.patch)].surface) +
         static_cast<std::uint64_t>(side.facing);
}

bool is_at_border(const ElementMesh& mesh, const MeshCell& cell) {
  const MeshSide& side = mesh.sides[index(cell.side)];
  const int nu = side.nu << cell.level, nv = side.nv << cell.level;
  if (!side.triangle)
    return cell.i == 0 || cell.j == 0 || cell.i == nu - 1 || cell.j == nv - 1;
  const int first = cell.flipped ? 1 : 0;
  return cell.i <= first || cell.j <= first || cell.i + cell.j >= nu - 1 + first;
}

void add_root_cells(ElementMesh& mesh) {
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const MeshSide& side = mesh.sides[s];
    MeshCell root;
    root.side = static_cast<SideId>(s);
    for (int j = 0; j < side.nv; ++j)
      for (int k = 0; k < (side.triangle ? 2 * (side.nu - j) - 1 : side.nu); ++k) {
        // In a row of triangles every second one is the upper half of its cell,
        // and starts at the far corner.
        root.flipped = side.triangle && k % 2 == 1;
        root.i = (side.triangle ? k / 2 : k) + (root.flipped ? 1 : 0);
        root.j = j + (root.flipped ? 1 : 0);
        mesh.cells.push_back(root);
      }
  }
}

void divide_cell(ElementMesh& mesh, std::uint32_t number) {
  const MeshCell parent = mesh.cells[number];
  const bool triangle = mesh.sides[index(parent.side)].triangle;
  const int step = parent.flipped ? -1 : 1;
  mesh.cells[number].first_child = static_cast<CellId>(mesh.cells.size());
  for (int k = 0; k < 4; ++k) {
    MeshCell child;
    child.parent = static_cast<CellId>(number);
    child.side = parent.side;
    child.level = static_cast<std::uint8_t>(parent.level + 1);
    child.flipped = triangle && k == 3 ? !parent.flipped : parent.flipped;
    child.i = 2 * parent.i + (k % 2 == 1 ? step : 0);
    child.j = 2 * parent.j + (k / 2 == 1 ? step : 0);
    mesh.cells.push_back(child);
  }
}

double vertex_grain(const ElementMesh& mesh, const SurfaceModel& surfaces) {
  return std::max(16.0 * surfaces.tolerance, 1e-7 * mesh.element_size);
}

} // namespace meninas
