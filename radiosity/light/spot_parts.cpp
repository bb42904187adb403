#include "radiosity/light/spot_parts.h"

#include "radiosity/mesh/subdivision.h"
#include "scenes/sampling.h"
#include "scenes/surfaces/shells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace meninas {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

using Triangles = std::vector<std::array<Point3, 3>>;

Triangles triangles_of(const ElementMesh& mesh, ElementId element) {
  if (const RegionElement* region = region_of(mesh, element))
    return region->triangles;
  const ElementCorners& corners = mesh.corners[index(element)];
  const auto at = [&](std::size_t c) { return mesh.vertices[index(corners[c])]; };
  Triangles triangles{{at(0), at(1), at(2)}};
  if (corners[3] != corners[2])
    triangles.push_back({at(0), at(2), at(3)});
  return triangles;
}

struct Sphere {
  Point3 centre{0.0};
  double radius = 0.0;
};

/// Around an element.
Sphere around(const Triangles& triangles) {
  Point3 low = triangles[0][0], high = low;
  for (const auto& triangle : triangles)
    for (const Point3& corner : triangle) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  return {0.5 * (low + high), 0.5 * glm::distance(low, high)};
}

/// A spot as it stands in a world.
struct Cone {
  Point3 apex;
  Direction axis;
  double angle;

  /// The distance of a point from the cone's surface, negative inside: exact before the apex.
  double distance(const Point3& x) const {
    const Vec3 to = x - apex;
    const double along = glm::dot(to, axis);
    const double across = glm::length(to - along * axis);
    return across * std::cos(angle) - along * std::sin(angle);
  }

  double width_at(const Point3& x) const {
    return angle < 0.5 * std::numbers::pi ? 2.0 * glm::distance(apex, x) * std::tan(angle)
                                          : infinite;
  }

  /// The polygon within the pyramid around the cone.
  void clip(ConvexPolygon& polygon) const {
    constexpr int sides = 8;
    const TangentFrame frame = tangent_frame(axis);
    for (int k = 0; k < sides && !polygon.empty(); ++k) {
      const double turn = 2.0 * std::numbers::pi * k / sides;
      const Vec3 outwards = std::cos(turn) * frame.tangent + std::sin(turn) * frame.bitangent;
      clip_in_place(polygon, apex, std::sin(angle) * axis - std::cos(angle) * outwards);
    }
  }
};

Cone cone_in(const MirrorWorld& world, const PunctualLight& light) {
  return {apply(world.image, light.position), apply_direction(world.image, light.direction),
          light.kind == PunctualKind::spot ? light.outer_cone : std::numbers::pi};
}

/// Adds a triangle in parts that are small as seen from y.
void add_small(const std::array<Point3, 3>& triangle, const Point3& y, SpotPart& part) {
  constexpr double small = 0.5; // longest edge over distance
  constexpr int max_depth = 48;
  std::vector<std::pair<std::array<Point3, 3>, int>> open{{triangle, 0}};
  while (!open.empty()) {
    const auto [corners, depth] = open.back();
    open.pop_back();
    std::size_t longest = 0;
    const auto edge = [&](std::size_t k) { return glm::distance(corners[k], corners[(k + 1) % 3]); };
    for (std::size_t k = 1; k < 3; ++k)
      longest = edge(k) > edge(longest) ? k : longest;
    const Point3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    if (depth < max_depth && edge(longest) > small * glm::distance(middle, y)) {
      const Point3 &a = corners[longest], &b = corners[(longest + 1) % 3],
                   &c = corners[(longest + 2) % 3];
      open.push_back({{a, 0.5 * (a + b), c}, depth + 1});
      open.push_back({{0.5 * (a + b), b, c}, depth + 1});
      continue;
    }
    const double omega = std::abs(solid_angle(corners, y));
    if (!(omega > 0.0))
      continue;
    part.triangles.push_back(corners);
    part.solid_angle_up_to.push_back(
        omega + (part.solid_angle_up_to.empty() ? 0.0 : part.solid_angle_up_to.back()));
  }
}

/// Fills the part of the triangles that is within the cone.
void add_lit(const Cone& cone, const Triangles& triangles, SpotPart& part) {
  for (const auto& triangle : triangles) {
    ConvexPolygon polygon{std::span(triangle)};
    if (cone.angle < 0.5 * std::numbers::pi)
      cone.clip(polygon);
    for (std::size_t k = 2; k < polygon.size; ++k)
      add_small({polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]}, cone.apex,
                part);
  }
}

/// By ElementId, 1 where fewer than four elements lie across a spot.
std::vector<std::uint8_t> under_spots_on(const ElementMesh& mesh, const Scene& scene,
                                             const WorldTree& worlds) {
  constexpr double wanted = 4.0;
  std::vector<PunctualLight> spots;
  std::ranges::copy_if(scene.lights, std::back_inserter(spots),
                       [](const PunctualLight& light) { return light.kind == PunctualKind::spot; });
  std::vector<std::uint8_t> marked(element_count(mesh), 0);
  if (spots.empty())
    return marked;
  tbb::parallel_for(std::size_t{0}, marked.size(), [&](std::size_t e) {
    const auto element = static_cast<ElementId>(e);
    const double size = size_of(mesh, element);
    marked[e] =
        std::ranges::any_of(spots_on(mesh, worlds, spots, element),
                            [&](const SpotPart& part) { return part.width < wanted * size; });
  });
  return marked;
}

} // namespace

SpotSample sample_spot(const SpotPart& part, Vec2 st) {
  const std::vector<double>& up_to = part.solid_angle_up_to;
  const double wanted = std::clamp(st.x, 0.0, 1.0) * up_to.back();
  const auto k =
      std::min(static_cast<std::size_t>(std::ranges::upper_bound(up_to, wanted) - up_to.begin()),
               up_to.size() - 1);
  const double before = k == 0 ? 0.0 : up_to[k - 1], own = up_to[k] - before;
  const double root = std::sqrt(std::clamp((wanted - before) / own, 0.0, 1.0));
  const auto& [a, b, c] = part.triangles[k];
  return {(1.0 - root) * a + root * ((1.0 - st.y) * b + st.y * c),
          glm::length(area_vector(part.triangles[k])) * up_to.back() / own};
}

std::vector<SpotPart> spots_on(const ElementMesh& mesh, const WorldTree& worlds,
                               std::span<const PunctualLight> lights, ElementId element) {
  std::vector<SpotPart> parts;
  const auto is_spot = [](const PunctualLight& light) { return light.kind == PunctualKind::spot; };
  const auto is_somewhere = [](const PunctualLight& light) {
    return light.kind != PunctualKind::directional;
  };
  if (std::ranges::none_of(lights, is_somewhere))
    return parts;
  const double widest = 16.0 * size_of(mesh, element);
  const Direction& normal = mesh.sides[index(mesh.side_of_element[index(element)])].normal;
  const Triangles triangles = triangles_of(mesh, element);
  const Sphere sphere = around(triangles);
  for (std::uint32_t w = 0; w < worlds.worlds.size(); ++w)
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      if (!is_somewhere(lights[k]))
        continue;
      const MirrorWorld& world = worlds.worlds[w];
      const Cone cone = cone_in(world, lights[k]);
      const bool is_close = glm::distance(cone.apex, sphere.centre) < 2.0 * sphere.radius;
      const double distance = is_spot(lights[k]) ? cone.distance(sphere.centre) : -widest;
      const double width = is_spot(lights[k]) ? cone.width_at(sphere.centre) : infinite;
      if ((width > widest && !is_close) || distance > sphere.radius ||
          !(glm::dot(cone.apex - sphere.centre, normal) > 0.0) ||
          (world.depth > 0 && signed_distance(world.plane, cone.apex) >= 0.0))
        continue;
      SpotPart part{k, static_cast<WorldId>(w), width, {}, {}};
      if (distance > -sphere.radius || is_close) {
        add_lit(cone, triangles, part);
        if (part.is_whole())
          continue;
      }
      parts.push_back(std::move(part));
    }
  return parts;
}

ElementMesh divide_under_spots(ElementMesh mesh, const Scene& scene, const SurfaceModel& surfaces,
                               const WorldTree& worlds, std::size_t max_elements) {
  constexpr int max_divisions = 6;
  constexpr std::size_t few = 2000;
  if (scene.lights.empty())
    return mesh;
  const std::size_t most = std::min(2 * element_count(mesh) + few, max_elements);
  for (int k = 0; k < max_divisions; ++k) {
    const auto marked = under_spots_on(mesh, scene, worlds);
    if (std::ranges::find(marked, 1) == marked.end())
      break;
    ElementMesh finer = divide_elements(mesh, surfaces, marked);
    if (element_count(finer) > most || element_count(finer) == element_count(mesh))
      break;
    mesh = std::move(finer);
  }
  return mesh;
}

} // namespace meninas
