#include "radiosity/mesh/element_lookup.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

namespace meninas {

/// The widening of a quad along its sides, p(u, v) = corner + u base + v side + u v (w_x base + w_y
/// side). None where they hardly span its plane, or where the opposite sides nearly vanish.
static std::optional<Vec2> widening_of(const Patch& patch) {
  constexpr double least = 0.1, most = 4.0; // single precision is good enough between
  const auto& p = patch.corners;
  const Vec3 base = p[1] - p[0], side = p[3] - p[0];
  const Vec3 widening = (p[0] - p[1]) + (p[2] - p[3]);
  const double bb = glm::dot(base, base), bs = glm::dot(base, side), ss = glm::dot(side, side);
  const double det = bb * ss - bs * bs;
  if (!(det > least * least * bb * ss))
    return std::nullopt;
  const double wb = glm::dot(widening, base), ws = glm::dot(widening, side);
  const Vec2 w((wb * ss - ws * bs) / det, (ws * bb - wb * bs) / det);
  // Convex quads have their fourth corner beyond the line through its neighbours.
  if (!(1.0 + w.x > least && 1.0 + w.y > least && 1.0 + w.x + w.y > least && w.x < most &&
        w.y < most))
    return std::nullopt;
  return w;
}

static void set_uv_map(FaceRecord& face, const Patch& patch, const std::array<Vec2, 3>& corner_uv) {
  std::array<Vec2, 3> at = corner_uv;
  if (!patch.affine) {
    const auto w = patch.corner_count == 4 ? widening_of(patch) : std::nullopt;
    face.map = w ? UvMap::bilinear : UvMap::general;
    if (w)
      for (auto& corner : at)
        corner += corner.x * corner.y * *w;
    face.widening = w.value_or(Vec2(0.0));
  }
  face.uv0 = at[0];
  face.uv1 = at[1] - at[0];
  face.uv2 = at[2] - at[0];
}

static FaceRecord make_face(const Scene& scene, const SurfaceModel& model, const MirrorSet& mirrors,
                            const ElementMesh& mesh, std::uint32_t triangle, int facing) {
  const PatchId patch_id = model.patch_of_triangle[triangle];
  const Patch& patch = model.patches[index(patch_id)];
  const Surface& surface = model.surfaces[index(patch.surface)];
  const Material& material = scene.materials[index(patch.material)];
  FaceRecord face;
  face.plane_class = index(surface.plane_class);
  face.normal = facing == 0 ? surface.plane.normal : -surface.plane.normal;
  if (facing == 1 && !material.double_sided)
    return face;

  face.side = index(mesh.sides_of_patch[index(patch_id)][static_cast<std::size_t>(facing)]);
  face.mapped = material.normal_texture.has_value();
  face.curved = face.mapped || scene.triangles[triangle].curved;
  face.glass = is_glass(material);
  face.solid = is_solid_glass(material);
  face.mirrors = is_mirror(material) || face.glass;
  face.coat = has_mirror_coat(material);
  face.mirror = mirrors.mirror_of_surface[index(patch.surface)][static_cast<std::size_t>(facing)];
  face.reflectance = mirror_reflectance(material);
  set_uv_map(face, patch, model.corner_uv[triangle]);
  return face;
}

/// From every cell to its children, its line or its element.
static void add_descent(const ElementMesh& mesh, ElementTable& table) {
  for (std::size_t number = 0; number < mesh.cells.size(); ++number) {
    const MeshCell& cell = mesh.cells[number];
    const bool is_cut = !mesh.line_of_cell.empty() && mesh.line_of_cell[number] != uncut;
    table.descent.push_back(!is_leaf(cell) ? index(cell.first_child)
                            : is_cut       ? ElementTable::cut | mesh.line_of_cell[number]
                                           : ElementTable::leaf | cell.first_element);
    if (!is_cut)
      continue;
    // The lines of a leaf follow one another, each after the one that leads to it.
    std::uint32_t last = mesh.line_of_cell[number];
    table.lines.resize(mesh.lines.size());
    for (std::uint32_t line = last; line <= last; ++line)
      for (std::size_t k = 0; k < 2; ++k) {
        const CellLine& from = mesh.lines[line];
        std::copy(from.line.begin(), from.line.end(), table.lines[line].line.begin());
        const bool ends = (from.next[k] & CellLine::region) != 0;
        table.lines[line].next[k] =
            ends ? ElementTable::leaf | (cell.first_element + (from.next[k] & ~CellLine::region))
                 : ElementTable::cut | from.next[k];
        if (!ends)
          last = std::max(last, from.next[k]);
      }
  }
}

ElementTable make_element_table(const ElementMesh& mesh, bool all_divided) {
  ElementTable table;
  const auto by_cells = [&](const MeshSide& side) { return all_divided || is_divided(side); };
  for (const auto& side : mesh.sides)
    table.sides.push_back({by_cells(side) ? side.first_cell : side.first_element, side.nu, side.nv,
                           side.triangle, by_cells(side)});
  if (std::any_of(mesh.sides.begin(), mesh.sides.end(), by_cells))
    add_descent(mesh, table);
  return table;
}

ElementLookup make_element_lookup(const Scene& scene, const SurfaceModel& surfaces,
                                const MirrorSet& mirrors, const ElementMesh& mesh,
                                Point3 frame_centre, double frame_scale) {
  ElementLookup table;
  table.faces.resize(2 * scene.triangles.size());
  tbb::parallel_for(std::size_t{0}, table.faces.size(), [&](std::size_t k) {
    const auto triangle = static_cast<std::uint32_t>(k / 2);
    FaceRecord& face = table.faces[k];
    face = make_face(scene, surfaces, mirrors, mesh, triangle, static_cast<int>(k % 2));
    // The plane through one of its own vertices, in the frame: n . (p - centre) scale.
    const Point3 p = position(scene, scene.triangles[triangle].vertices[0]);
    face.frame_offset = glm::dot(face.normal, (p - frame_centre) * frame_scale);
  });
  table.elements = make_element_table(mesh);
  return table;
}

glm::vec2 general_uv(const SurfaceModel& surfaces, std::uint32_t triangle, float b1, float b2) {
  return patch_uv(surfaces, static_cast<TriangleId>(triangle), Vec2(b1, b2));
}

} // namespace meninas
