#include "radiosity/element_mesh.h"

#include "radiosity/edge_divisions.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace meninas {

namespace {

bool carries_radiosity(const Material& material) {
  if (is_emitter(material) || !is_mirror(material))
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
  side.node = patch.node;
  side.nu = divisions.u;
  side.nv = divisions.v;
  side.triangle = patch.corner_count == 3;
  side.element_count = elements_of(side.nu, side.nv, side.triangle);
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
      side.first_element = static_cast<std::uint32_t>(total);
      total += side.element_count;
      mesh.sides_of_patch[p][static_cast<std::size_t>(facing)] =
          static_cast<SideId>(mesh.sides.size());
      mesh.sides.push_back(side);
    }
  }
}

double area_of(std::span<const Point3> polygon) {
  Vec3 sum(0.0);
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += glm::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * glm::length(sum);
}

/// Shared vertices by position: those of one surface side that round to the same cell are one vertex.
class VertexWelder {
public:
  VertexWelder(std::vector<Point3>& vertices, double cell) : vertices_(vertices), cell_(cell) {}

  void start_surface(std::uint64_t surface_side) { surface_side_ = surface_side; }

  ElementVertexId vertex_at(const Point3& x) {
    const auto place = [this](double c) {
      return static_cast<std::int64_t>(std::floor(c / cell_ + 0.37));
    };
    const Key key{place(x.x), place(x.y), place(x.z), surface_side_};
    const auto [entry, is_new] =
        known_.emplace(key, static_cast<ElementVertexId>(vertices_.size()));
    if (is_new)
      vertices_.push_back(x);
    return entry->second;
  }

private:
  struct Key {
    std::int64_t x, y, z;
    std::uint64_t surface_side;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = k.surface_side * 0x9e3779b97f4a7c15ULL;
      for (const std::int64_t c : {k.x, k.y, k.z})
        h = (h ^ static_cast<std::uint64_t>(c)) * 0xff51afd7ed558ccdULL + (h >> 29U);
      return h;
    }
  };
  std::vector<Point3>& vertices_;
  double cell_;
  std::uint64_t surface_side_ = 0;
  std::unordered_map<Key, ElementVertexId, KeyHash> known_;
};

std::array<Vec2, 4> corner_coordinates(bool triangle) {
  if (triangle)
    return {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, 1.0)};
  return {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0), Vec2(0.0, 1.0)};
}

void add_elements(ElementMesh& mesh, const SurfaceModel& model, double weld_cell) {
  VertexWelder welder(mesh.vertices, weld_cell);
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const MeshSide& side = mesh.sides[s];
    const Patch& patch = model.patches[index(side.patch)];
    welder.start_surface(2ULL * index(patch.surface) + static_cast<std::uint64_t>(side.facing));
    const auto coordinates = corner_coordinates(side.triangle);
    for (std::uint32_t e = 0; e < side.element_count; ++e) {
      ElementCorners corners;
      std::array<Point3, 4> points;
      for (std::size_t c = 0; c < 4; ++c) {
        points[c] = point_at(patch, patch_uv_of(side, e, coordinates[c]));
        corners[c] = c == 3 && side.triangle ? corners[2] : welder.vertex_at(points[c]);
      }
      mesh.side_of_element.push_back(static_cast<SideId>(s));
      mesh.corners.push_back(corners);
      mesh.area.push_back(area_of(std::span(points).first(side.triangle ? 3 : 4)));
    }
  }
  mesh.element_of_vertex.assign(mesh.vertices.size(), none<ElementId>);
  for (std::size_t e = mesh.corners.size(); e-- > 0;)
    for (const auto vertex : mesh.corners[e])
      mesh.element_of_vertex[index(vertex)] = static_cast<ElementId>(e);
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
  mesh.side_of_element.reserve(elements);
  mesh.corners.reserve(elements);
  mesh.area.reserve(elements);
  add_elements(mesh, surfaces, std::max(16.0 * surfaces.tolerance, 1e-7 * mesh.element_size));
  return mesh;
}

ElementPoint locate(const MeshSide& side, Vec2 uv) {
  const double fu = std::clamp(uv.x, 0.0, 1.0) * side.nu;
  const double fv = std::clamp(uv.y, 0.0, 1.0) * side.nv;
  if (!side.triangle) {
    const int i = std::min(static_cast<int>(fu), side.nu - 1);
    const int j = std::min(static_cast<int>(fv), side.nv - 1);
    return {
        static_cast<ElementId>(side.first_element + static_cast<std::uint32_t>(j * side.nu + i)),
        {fu - i, fv - j}};
  }

  // Row j holds 2 (n - j) - 1 triangles, so it starts at j (2n - j); beyond the diagonal of its cell a point is in the upper one.
  const int n = side.nu;
  const int j = std::min(static_cast<int>(fv), n - 1);
  const int i = std::min(static_cast<int>(fu), n - 1 - j);
  const double s = fu - i, t = fv - j;
  const bool upper = s + t > 1.0 && i + j < n - 1;
  const auto local = static_cast<std::uint32_t>(j * (2 * n - j) + 2 * i + (upper ? 1 : 0));
  return {static_cast<ElementId>(side.first_element + local),
          upper ? Vec2(1.0 - s, 1.0 - t) : Vec2(s, t)};
}

Vec2 patch_uv_of(const MeshSide& side, std::uint32_t local_element, Vec2 st) {
  const int n = side.nu;
  if (!side.triangle) {
    const int i = static_cast<int>(local_element) % n, j = static_cast<int>(local_element) / n;
    return {(i + st.x) / side.nu, (j + st.y) / side.nv};
  }

  // The row is the largest j with j (2n - j) <= local_element.
  const double root = n - std::sqrt(static_cast<double>(n) * n - local_element);
  int j = std::clamp(static_cast<int>(root), 0, n - 1);
  while (j + 1 < n && static_cast<std::uint32_t>((j + 1) * (2 * n - j - 1)) <= local_element)
    ++j;
  while (j > 0 && static_cast<std::uint32_t>(j * (2 * n - j)) > local_element)
    --j;
  const int in_row = static_cast<int>(local_element) - j * (2 * n - j);
  const int i = in_row / 2;
  if (in_row % 2 == 1)
    return {(i + 1 - st.x) / n, (j + 1 - st.y) / n};
  return {(i + st.x) / n, (j + st.y) / n};
}

} // namespace meninas
