#include "radiosity/element_mesh.h"

#include "radiosity/cell_children.h"
#include "radiosity/edge_divisions.h"
#include "radiosity/mesh_cells.h"
#include "scenes/errors.h"
#include "scenes/texture_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

bool carries_radiosity(const Material& material) {
  if (is_emitter(material) || !(is_mirror(material) || is_glass(material)))
    return true;
  // Where its texture of transmission is black glass is opaque.
  if (material.transmission_texture)
    return true;
  // And where its texture of metalness is, it is no metal.
  if (material.metallic_roughness_texture && material.transmission < 1.0)
    return true;
  return glm::any(glm::greaterThan(diffuse_reflectance(material), Rgb(0.0)));
}

std::uint32_t elements_of(int nu, int nv, bool triangle) {
  return static_cast<std::uint32_t>(nu) * static_cast<std::uint32_t>(triangle ? nu : nv);
}

MeshSide make_side(const Scene& scene, const SurfaceModel& model, PatchId id, Facing facing,
                   Divisions divisions) {
  const Patch& patch = model.patches[index(id)];
  const Surface& surface = model.surfaces[index(patch.surface)];
  const Material& material = scene.materials[index(patch.material)];
  const double sign = facing == Facing::front ? 1.0 : -1.0;
  MeshSide side;
  side.patch = id;
  side.facing = facing;
  side.plane = {sign * surface.plane.normal, sign * surface.plane.offset};
  side.normal = side.plane.normal;
  side.tangent = glm::normalize(patch.corners[1] - patch.corners[0]);
  side.plane_class = surface.plane_class;
  side.material = patch.material;
  side.coat = has_mirror_coat(material) ? patch.material : none<MaterialId>;
  side.node = patch.node;
  side.nu = divisions.u;
  side.nv = divisions.v;
  side.triangle = patch.corner_count == 3;
  side.root_count = elements_of(side.nu, side.nv, side.triangle);
  const auto is_colored = [&](TriangleId t) {
    return t != none<TriangleId> && has_vertex_colors(scene, t);
  };
  side.textured = is_textured(material) || material.alpha_mode == AlphaMode::mask ||
                  std::ranges::any_of(patch.triangles, is_colored);
  side.reflectance = diffuse_reflectance(material);
  side.emission = std::numbers::pi * material.emission;
  return side;
}

void add_sides(ElementMesh& mesh, const Scene& scene, const SurfaceModel& model,
               const std::vector<Divisions>& divisions, const DarkSides& dark) {
  std::uint64_t total = 0;
  mesh.sides_of_patch.assign(model.patches.size(), {none<SideId>, none<SideId>});
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const Material& material = scene.materials[index(model.patches[p].material)];
    if (!carries_radiosity(material))
      continue;
    for (int facing = 0; facing < (material.double_sided ? 2 : 1); ++facing) {
      if (!dark.empty() && dark[p][static_cast<std::size_t>(facing)] != 0)
        continue;
      MeshSide side = make_side(scene, model, static_cast<PatchId>(p), static_cast<Facing>(facing),
                                divisions[p]);
      side.first_cell = static_cast<std::uint32_t>(total);
      total += side.root_count;
      mesh.sides_of_patch[p][static_cast<std::size_t>(facing)] =
          static_cast<SideId>(mesh.sides.size());
      mesh.sides.push_back(side);
    }
  }
}

/// Area of all sides that carry radiosity, and the number of elements a size would make of them.
struct Extent {
  double area = 0.0;
  std::uint64_t elements = 0;
};

Extent extent_of(const Scene& scene, const SurfaceModel& model,
                 const std::vector<Divisions>& divisions, const DarkSides& dark) {
  Extent extent;
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const Patch& patch = model.patches[p];
    const Material& material = scene.materials[index(patch.material)];
    if (!carries_radiosity(material))
      continue;
    const unsigned dark_sides = dark.empty() ? 0U : static_cast<unsigned>(dark[p][0] + dark[p][1]);
    const unsigned sides = (material.double_sided ? 2U : 1U) - dark_sides;
    extent.area += sides * patch.area;
    if (!divisions.empty())
      extent.elements += sides * static_cast<std::uint64_t>(elements_of(
                                     divisions[p].u, divisions[p].v, patch.corner_count == 3));
  }
  return extent;
}

} // namespace

ElementMesh make_element_mesh(const Scene& scene, const SurfaceModel& surfaces,
                              const MeshSettings& settings, const DarkSides& dark) {
  ElementMesh mesh;
  mesh.element_size = settings.element_size;
  if (mesh.element_size <= 0.0)
    mesh.element_size = std::sqrt(extent_of(scene, surfaces, {}, dark).area /
                                  std::max(settings.target_elements, 1.0));
  if (mesh.element_size <= 0.0)
    mesh.element_size = 1.0;

  // A derived size grows until the mesh fits; a chosen one is the user's word.
  auto divisions = divide_edges(surfaces, mesh.element_size);
  auto elements = extent_of(scene, surfaces, divisions, dark).elements;
  while (elements > settings.max_elements) {
    if (settings.element_size > 0.0)
      throw UsageError("--element-size",
                       fmt::format("{} m needs {} elements, more than {}", settings.element_size,
                                   elements, settings.max_elements));
    if (elements <= 2 * surfaces.patches.size())
      break; // one element a side is the least there is
    mesh.element_size *= 1.4;
    divisions = divide_edges(surfaces, mesh.element_size);
    elements = extent_of(scene, surfaces, divisions, dark).elements;
  }

  add_sides(mesh, scene, surfaces, divisions, dark);
  add_root_cells(mesh);
  add_elements(mesh, surfaces);
  return mesh;
}

namespace {

/// A cell by its number, and where in it a point is.
struct CellPoint {
  std::uint32_t cell;
  Vec2 st;
};

CellPoint locate_root(const MeshSide& side, Vec2 uv) {
  const double fu = std::clamp(uv.x, 0.0, 1.0) * side.nu;
  const double fv = std::clamp(uv.y, 0.0, 1.0) * side.nv;
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
  return {static_cast<ElementId>(mesh.cells[at.cell].first_element), at.st};
}

Vec2 patch_uv_of(const ElementMesh& mesh, const MeshCell& cell, Vec2 st) {
  const MeshSide& side = mesh.sides[index(cell.side)];
  const double sign = cell.flipped ? -1.0 : 1.0;
  return {(cell.i + sign * st.x) / (side.nu << cell.level),
          (cell.j + sign * st.y) / (side.nv << cell.level)};
}

} // namespace meninas
