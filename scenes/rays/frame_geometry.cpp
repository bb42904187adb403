#include "scenes/rays/frame_geometry.h"

#include "scenes/rays/hidden_copies.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace meninas {

namespace {

// Floats in [-1, 1] are rounded by at most 3e-8 per coordinate,
// of the origin and of three vertices alike, and Embree's arithmetic adds as much again.
constexpr double float_noise = 4e-7;

RayFrame frame_of(const Scene& scene, const Detail& detail) {
  Point3 low(std::numeric_limits<double>::infinity());
  Point3 high(-std::numeric_limits<double>::infinity());
  for (const auto& triangle : scene.triangles)
    for (const auto vertex : triangle.vertices) {
      low = glm::min(low, position(scene, vertex));
      high = glm::max(high, position(scene, vertex));
    }
  if (scene.triangles.empty())
    return {};
  const auto size = high - low;
  const auto centre = detail.is_all ? low + 0.5 * size : detail.centre;
  const auto reach = detail.is_all ? 0.5 * size : glm::max(high - centre, centre - low);
  const auto scale = 1.0 / std::max({reach.x, reach.y, reach.z});
  return {centre, std::isfinite(scale) && scale > 0.0 ? scale : 1.0};
}

float farthest_grain(const FrameGeometry& geometry, std::uint32_t triangle) {
  float grain = geometry.detail;
  for (const Point3& corner : corners_of(geometry, triangle))
    grain = std::max(grain, grain_at(geometry, glm::vec3(corner)));
  return grain;
}

/// What the surfaces allow for, by the grain of where they are.
double tolerance_of(const FrameGeometry& geometry, const SurfaceModel& surfaces) {
  double largest = surfaces.tolerance / double{geometry.detail};
  if (geometry.detail < 1.0F)
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t)
      largest = std::max(largest, surface_of(surfaces, TriangleId{t}).tolerance /
                                      double{farthest_grain(geometry, t)});
  return geometry.frame.scale * largest;
}

// A plane class with faces both ways, or with double-sided ones, may hold sheets modelled as two.
std::vector<bool> classes_with_sheets(const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<bool> along(surfaces.planes.size(), false);
  std::vector<bool> against(surfaces.planes.size(), false);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto plane = index(surfaces.plane_of_triangle[t]);
    const auto both = material_of(scene, TriangleId{t}).double_sided;
    const auto forward =
        glm::dot(area_vector(corners(scene, TriangleId{t})), surfaces.planes[plane].normal) >= 0.0;
    if (forward || both)
      along[plane] = true;
    if (!forward || both)
      against[plane] = true;
  }
  for (std::size_t plane = 0; plane < along.size(); ++plane)
    along[plane] = along[plane] && against[plane];
  return along;
}

} // namespace

FrameGeometry make_frame_geometry(const Scene& scene, const SurfaceModel& surfaces, Holes holes) {
  expects(surfaces.plane_of_triangle.size() == scene.triangles.size(),
          "the surfaces belong to another scene");
  FrameGeometry geometry;
  geometry.frame = frame_of(scene, surfaces.detail);
  if (!surfaces.detail.is_all)
    geometry.detail =
        static_cast<float>(std::clamp(surfaces.detail.radius * geometry.frame.scale, 1e-30, 1.0));

  geometry.positions.reserve(scene.vertices.size());
  for (const auto& vertex : scene.vertices)
    geometry.positions.push_back(to_frame(geometry.frame, vertex.position));

  const auto sheets = classes_with_sheets(scene, surfaces);
  const auto hidden = hidden_copies(scene);
  std::set<std::uint32_t> glass;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& v = scene.triangles[t].vertices;
    const auto plane = index(surfaces.plane_of_triangle[t]);
    geometry.triangles.push_back({index(v[0]), index(v[1]), index(v[2])});
    const Material& material = material_of(scene, TriangleId{t});
    geometry.facts.push_back({plane, !material.double_sided, sheets[plane],
                              holes && material.alpha_mode == AlphaMode::mask, hidden[t],
                              is_glass(material), is_solid_glass(material)});
    if (is_glass(material))
      glass.insert(plane);
  }

  geometry.noise = float_noise + 2.0 * tolerance_of(geometry, surfaces);

  for (const std::uint32_t plane : glass)
    geometry.glass.push_back(surfaces.planes[plane]);
  for (const auto& plane : surfaces.planes) {
    const glm::vec3 normal(plane.normal);
    geometry.plane_normals.push_back(plane.normal);
    geometry.lifts.push_back({normal.x, normal.y, normal.z});
  }
  geometry.lifts.push_back({});
  geometry.holes = std::move(holes);
  return geometry;
}

std::array<Point3, 3> corners_of(const FrameGeometry& geometry, std::uint32_t triangle) {
  const auto& v = geometry.triangles[triangle];
  return {geometry.positions[v[0]], geometry.positions[v[1]], geometry.positions[v[2]]};
}

} // namespace meninas
