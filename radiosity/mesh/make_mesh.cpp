#include "radiosity/mesh/make_mesh.h"

#include "radiosity/mesh/contact_segments.h"
#include "radiosity/mesh/edge_divisions.h"
#include "radiosity/mesh/element_sizes.h"
#include "radiosity/mesh/mesh_cells.h"
#include "radiosity/mesh/mesh_elements.h"
#include "scenes/errors.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/texture_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace meninas {

namespace {

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
  if (is_translucent(material))
    side.transmittance = diffuse_transmittance(material, untextured(material));
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

/// The number of elements that divisions make.
std::uint64_t elements_of(const Scene& scene, const SurfaceModel& model,
                          const std::vector<Divisions>& divisions, const DarkSides& dark) {
  std::uint64_t elements = 0;
  for (std::size_t p = 0; p < model.patches.size(); ++p)
    elements += std::uint64_t{meshed_sides(scene, model, static_cast<PatchId>(p), dark)} *
                elements_of(divisions[p].u, divisions[p].v, model.patches[p].corner_count == 3);
  return elements;
}

/// The wanted element size of each surface.
ElementSizes sizes_of(const Scene& scene, const SurfaceModel& surfaces,
                      const MeshSettings& settings, const DarkSides& dark) {
  if (settings.element_size <= 0.0) {
    const ElementSizes shared =
        share_elements(meshed_areas(scene, surfaces, dark), settings.target_elements);
    if (shared.element_size > 0.0)
      return shared;
  }
  const double size = settings.element_size > 0.0 ? settings.element_size : 1.0;
  return {size, std::vector<double>(surfaces.surfaces.size(), size)};
}

/// The number of sides in the mesh: each takes one element at least.
double sides_in_mesh(const Scene& scene, const SurfaceModel& surfaces, const DarkSides& dark) {
  double sides = 0.0;
  for (std::size_t p = 0; p < surfaces.patches.size(); ++p)
    sides += meshed_sides(scene, surfaces, static_cast<PatchId>(p), dark);
  return sides;
}

struct Division {
  std::vector<Divisions> of_patch;
  double elements = 0.0;
};

void enlarge(ElementSizes& sizes, double times) {
  sizes.element_size *= times;
  for (double& size : sizes.of_surface)
    size *= times;
}

/// Patches of many sizes that share edges would all be divided like the largest, and triangles
/// have twice the elements of quads. Beyond twice the wanted number, and one element a side,
/// patches agree on fewer edges, and all elements are as much larger as it takes.
void fit_to_target(double asked, const std::function<Division(double)>& divide,
                   ElementSizes& sizes, Division& division) {
  constexpr double most = 2.0, enough = 1.25;
  if (division.elements <= most * asked)
    return;
  double max_times = 4.0;
  for (const double fewer : {2.0, 1.5}) {
    if (division.elements <= enough * asked)
      return;
    max_times = fewer;
    division = divide(max_times);
  }
  for (int k = 0; k < 8 && division.elements > enough * asked; ++k) {
    enlarge(sizes, std::max(1.05, std::sqrt(division.elements / asked)));
    division = divide(max_times);
  }
}

} // namespace

ElementMesh make_element_mesh(const Scene& scene, const SurfaceModel& surfaces,
                              const MeshSettings& settings, const DarkSides& dark) {
  ElementSizes sizes = sizes_of(scene, surfaces, settings, dark);
  const auto divide = [&](double max_times) {
    Division division{divide_edges(surfaces, sizes.of_surface, max_times)};
    division.elements =
        static_cast<double>(elements_of(scene, surfaces, division.of_patch, dark));
    return division;
  };
  Division division = divide(4.0);
  if (settings.element_size <= 0.0)
    fit_to_target(settings.target_elements + sides_in_mesh(scene, surfaces, dark), divide, sizes,
                  division);

  // A derived size grows until the mesh fits; a chosen one is the user's word.
  while (division.elements > static_cast<double>(settings.max_elements)) {
    if (settings.element_size > 0.0)
      throw UsageError("--element-size",
                       fmt::format("{} m needs {} elements, more than {}", settings.element_size,
                                   static_cast<std::uint64_t>(division.elements),
                                   settings.max_elements));
    if (division.elements <= 2.0 * static_cast<double>(surfaces.patches.size()))
      break; // one element a side is the least there is
    enlarge(sizes, 1.4);
    division = divide(4.0);
  }

  ElementMesh mesh;
  mesh.element_size = sizes.element_size;
  add_sides(mesh, scene, surfaces, division.of_patch, dark);
  for (MeshSide& side : mesh.sides)
    side.element_size = sizes.of_surface[index(surfaces.patches[index(side.patch)].surface)];
  add_root_cells(mesh);
  mesh.contacts = std::make_shared<const ContactSegments>(find_contact_segments(scene, surfaces, mesh));
  add_elements(mesh, surfaces);
  return mesh;
}

} // namespace meninas
