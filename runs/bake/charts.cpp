#include "runs/bake/charts.h"

#include "scenes/surfaces/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace meninas {

namespace {

using Corners3 = std::array<Point3, 3>;

double longest_edge(const Corners3& p) {
  return std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
}

Point3 centroid_of(const Corners3& p) { return (p[0] + p[1] + p[2]) / 3.0; }

/// Which corner of the one triangle stands where each of the other's does, and how far off at most.
struct Match {
  TriangleId triangle = none<TriangleId>;
  std::size_t turn = 0; ///< corner k of the file's triangle is corner k + turn of the scene's
  double distance = std::numeric_limits<double>::infinity();
};

/// Which triangles of the file are which of the scene.
class FaceFinder {
public:
  explicit FaceFinder(const Scene& scene)
      : scene_(scene), tree_(centroids(scene)), of_node_(scene.nodes.size()) {
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
      of_node_[index(scene.triangles[t].node)].push_back(TriangleId{t});
  }

  /// The same triangle, but for what repairs have moved it by.
  Match same(NodeId node, const Corners3& face) const {
    constexpr double moved = 0.02; // of its longest edge
    const double reach = moved * longest_edge(face);
    const Point3 middle = centroid_of(face);
    Match best;
    tree_.visit_inside({middle - Vec3(reach), middle + Vec3(reach)}, [&](std::uint32_t t) {
      if (scene_.triangles[t].node != node)
        return true;
      const auto there = corners(scene_, TriangleId{t});
      for (std::size_t turn = 0; turn < 3; ++turn) {
        double farthest = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
          farthest = std::max(farthest, glm::distance(face[k], there[(k + turn) % 3]));
        if (farthest < best.distance)
          best = {TriangleId{t}, turn, farthest};
      }
      return true;
    });
    if (!(best.distance <= reach))
      best.triangle = none<TriangleId>;
    return best;
  }

  /// Those that lie where the triangle does and face the same way.
  std::vector<TriangleId> covering(NodeId node, const Corners3& face) const {
    const double reach = 1e-3 * longest_edge(face);
    const Vec3 area = area_vector(face);
    const double twice = glm::length(area);
    std::vector<TriangleId> found;
    if (!(twice > 0.0))
      return found;
    const Direction normal = area / twice;
    const Point3 low = glm::min(glm::min(face[0], face[1]), face[2]) - reach,
                 high = glm::max(glm::max(face[0], face[1]), face[2]) + reach;
    for (const TriangleId id : of_node_[index(node)]) {
      const auto p = corners(scene_, id);
      if (glm::any(glm::lessThan(glm::max(glm::max(p[0], p[1]), p[2]), low)) ||
          glm::any(glm::greaterThan(glm::min(glm::min(p[0], p[1]), p[2]), high)))
        continue;
      const Vec3 other = area_vector(p);
      if (glm::dot(other, normal) > 0.999 * glm::length(other) &&
          std::abs(glm::dot(p[0] - face[0], normal)) <= reach)
        found.push_back(id);
    }
    return found;
  }

private:
  static std::vector<Point3> centroids(const Scene& scene) {
    std::vector<Point3> points;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
      points.push_back(centroid_of(corners(scene, TriangleId{t})));
    return points;
  }

  const Scene& scene_;
  PointTree tree_;
  std::vector<std::vector<TriangleId>> of_node_;
};

/// What the two faces of a surface receive, W, and how finely they are divided.
struct SurfaceLight {
  std::array<double, 2> flux{0.0, 0.0};
  std::array<bool, 2> lit{false, false};
  int level = 0;
};

std::vector<SurfaceLight> light_of_surfaces(const IrradianceField& field) {
  const LightScene& light = *field.scene;
  const ElementMesh& mesh = light.mesh;
  std::vector<SurfaceLight> all(light.surfaces.surfaces.size());
  for (const MeshSide& side : mesh.sides) {
    const Patch& patch = light.surfaces.patches[index(side.patch)];
    SurfaceLight& one = all[index(patch.surface)];
    const auto facing = static_cast<std::size_t>(side.facing);
    one.lit[facing] = true;
    for (std::uint32_t e = side.first_element; e < side.first_element + side.element_count; ++e) {
      for (const ElementVertexId corner : mesh.corners[e])
        one.flux[facing] += 0.25 * mesh.area[e] * double(largest(field.irradiance[index(corner)]));
      one.level = std::max(one.level, int{cell_of(mesh, ElementId{e}).level});
    }
  }
  return all;
}

class ChartFinder {
public:
  explicit ChartFinder(const IrradianceField& field)
      : light_(*field.scene), faces_(light_.scene), surfaces_(light_of_surfaces(field)) {}

  FileCharts find(const std::vector<gltf::PlacedPrimitive>& primitives) {
    for (const gltf::PlacedPrimitive& primitive : primitives) {
      auto& corners = found_.corners.emplace_back();
      corners.reserve(primitive.triangles.size());
      for (const gltf::Corners& triangle : primitive.triangles)
        corners.push_back(corners_of(primitive, triangle));
    }
    for (const NodeId node : two_lit_)
      found_.two_lit.push_back(light_.scene.nodes[index(node)].name);
    return std::move(found_);
  }

private:
  std::array<ChartPoint, 3> corners_of(const gltf::PlacedPrimitive& primitive,
                                       gltf::Corners triangle) {
    if (primitive.mirrored)
      std::swap(triangle[1], triangle[2]);
    const Corners3 face{primitive.positions[triangle[0]], primitive.positions[triangle[1]],
                        primitive.positions[triangle[2]]};
    auto points = points_of(primitive.node, face);
    if (primitive.mirrored)
      std::swap(points[1], points[2]);
    return points;
  }

  std::array<ChartPoint, 3> points_of(NodeId node, const Corners3& face) {
    std::array<ChartPoint, 3> points{};
    if (const Match match = faces_.same(node, face); match.triangle != none<TriangleId>) {
      const std::uint32_t chart = chart_of(light_.surfaces.patch_of_triangle[index(match.triangle)]);
      for (std::size_t k = 0; k < 3 && chart != no_chart; ++k)
        points[k] = {chart, light_.surfaces.corner_uv[index(match.triangle)][(k + match.turn) % 3]};
      return points;
    }
    const std::uint32_t chart = chart_of_face(node, face);
    for (std::size_t k = 0; k < 3 && chart != no_chart; ++k)
      points[k] = {chart, Vec2(k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0)};
    return points;
  }

  /// Which face of its surface is shown; none where neither is lit.
  std::optional<Facing> shown_facing(const Patch& patch) {
    const SurfaceLight& light = surfaces_[index(patch.surface)];
    if (!light.lit[0] && !light.lit[1])
      return std::nullopt;
    constexpr double much = 0.25;
    const auto [less, more] = std::minmax(light.flux[0], light.flux[1]);
    if (light.lit[0] && light.lit[1] && less > much * more)
      two_lit_.insert(patch.node);
    const bool back = !light.lit[0] || (light.lit[1] && light.flux[1] > light.flux[0]);
    return back ? Facing::back : Facing::front;
  }

  std::uint32_t chart_of(PatchId id) {
    const auto [known, is_new] = of_patch_.emplace(id, no_chart);
    if (!is_new)
      return known->second;
    const Patch& patch = light_.surfaces.patches[index(id)];
    const auto facing = shown_facing(patch);
    if (!facing)
      return no_chart;
    const SideId side = light_.mesh.sides_of_patch[index(id)][static_cast<std::size_t>(*facing)];
    if (side == none<SideId>)
      return no_chart;
    Chart chart;
    for (const TriangleId triangle : patch.triangles)
      if (triangle != none<TriangleId>)
        chart.triangles.push_back(triangle);
    chart.facing = *facing;
    chart.triangle = patch.corner_count == 3;
    chart.roots = {light_.mesh.sides[index(side)].nu, light_.mesh.sides[index(side)].nv};
    chart.level = surfaces_[index(patch.surface)].level;
    const auto polygon = polygon_of(patch);
    for (std::size_t k = 0; k < polygon.size(); ++k)
      chart.length = std::max(chart.length,
                              glm::distance(polygon[k], polygon[(k + 1) % polygon.size()]));
    return known->second = add(std::move(chart));
  }

  std::uint32_t chart_of_face(NodeId node, const Corners3& face) {
    Chart chart{.triangles = faces_.covering(node, face), .face = face};
    if (chart.triangles.empty())
      return no_chart;
    const Patch& patch = light_.surfaces.patches[index(
        light_.surfaces.patch_of_triangle[index(chart.triangles.front())])];
    const auto facing = shown_facing(patch);
    if (!facing)
      return no_chart;
    chart.facing = *facing;
    chart.triangle = true;
    chart.length = longest_edge(face);
    chart.level = surfaces_[index(patch.surface)].level;
    const double roots = std::ceil(chart.length / light_.mesh.element_size);
    constexpr double most = 4096.0;
    chart.roots[0] = chart.roots[1] = static_cast<int>(std::clamp(roots, 1.0, most));
    return add(std::move(chart));
  }

  std::uint32_t add(Chart chart) {
    found_.charts.push_back(std::move(chart));
    return static_cast<std::uint32_t>(found_.charts.size() - 1);
  }

  const LightScene& light_;
  FaceFinder faces_;
  std::vector<SurfaceLight> surfaces_;
  FileCharts found_;
  std::map<PatchId, std::uint32_t> of_patch_;
  std::set<NodeId> two_lit_;
};

/// Weights of the second and third corner of (a, b) in a triangle of the plane.
Vec2 barycentric_in(const std::array<Vec2, 3>& p, Vec2 at) {
  const Vec2 e1 = p[1] - p[0], e2 = p[2] - p[0], d = at - p[0];
  const double area = e1.x * e2.y - e1.y * e2.x;
  return Vec2(d.x * e2.y - d.y * e2.x, e1.x * d.y - e1.y * d.x) / area;
}

Vec2 barycentric_in(const Corners3& p, const Point3& x) {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], normal = glm::cross(e1, e2);
  return Vec2(glm::dot(glm::cross(x - p[0], e2), normal), glm::dot(glm::cross(e1, x - p[0]), normal)) /
         glm::dot(normal, normal);
}

double min_weight(Vec2 b) { return std::min({b.x, b.y, 1.0 - b.x - b.y}); }

Vec2 clamped(Vec2 b) {
  b = glm::max(b, Vec2(0.0));
  return b / std::max(1.0, b.x + b.y);
}

} // namespace

FileCharts find_charts(const IrradianceField& field,
                       const std::vector<gltf::PlacedPrimitive>& primitives) {
  return ChartFinder(field).find(primitives);
}

Vec2 barycentric_at(const LightScene& light, const Chart& chart, TriangleId triangle, Vec2 at) {
  if (!chart.face)
    return barycentric_in(light.surfaces.corner_uv[index(triangle)], at);
  const auto& [p0, p1, p2] = *chart.face;
  return barycentric_in(corners(light.scene, triangle),
                        (1.0 - at.x - at.y) * p0 + at.x * p1 + at.y * p2);
}

ChartPlace place_in_scene(const LightScene& light, const Chart& chart, Vec2 at) {
  ChartPlace best;
  double most = -std::numeric_limits<double>::infinity();
  for (const TriangleId id : chart.triangles) {
    const Vec2 b = barycentric_at(light, chart, id, at);
    if (const double least = min_weight(b); least > most) {
      most = least;
      best = {id, b};
    }
  }
  best.barycentric = clamped(best.barycentric);
  return best;
}

glm::vec3 irradiance_at(const IrradianceField& field, const VertexIrradiance& values,
                        const Chart& chart, const ChartPlace& place) {
  const LightScene& light = *field.scene;
  const PatchId patch = light.surfaces.patch_of_triangle[index(place.triangle)];
  const SideId id = light.mesh.sides_of_patch[index(patch)][static_cast<std::size_t>(chart.facing)];
  if (id == none<SideId>)
    return glm::vec3(0.0F);
  const Vec2 uv = patch_uv(light.surfaces, place.triangle, place.barycentric);
  const glm::vec3 own = irradiance_at(light.mesh, values, id, uv);
  const SideId behind = side_behind(light.mesh, id);
  if (behind == none<SideId>)
    return own;
  const MeshSide& side = light.mesh.sides[index(id)];
  const glm::vec3 ratio(side.transmittance / glm::max(side.reflectance, Rgb(1e-6)));
  return own + glm::min(ratio, glm::vec3(1e3F)) * irradiance_at(light.mesh, values, behind, uv);
}

} // namespace meninas
