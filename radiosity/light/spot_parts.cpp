#include "radiosity/light/spot_parts.h"

#include "radiosity/mesh/subdivision.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meninas {
namespace {

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
                                          : std::numeric_limits<double>::infinity();
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
          light.outer_cone};
}

void add_polygon(RegionElement& region, const ConvexPolygon& polygon) {
  for (std::size_t k = 2; k < polygon.size; ++k) {
    const std::array<Point3, 3> triangle{polygon.vertices[0], polygon.vertices[k - 1],
                                         polygon.vertices[k]};
    const double area = glm::length(area_vector(triangle));
    if (!(area > 0.0))
      continue;
    region.triangles.push_back(triangle);
    region.area_up_to.push_back(area +
                                (region.area_up_to.empty() ? 0.0 : region.area_up_to.back()));
  }
}

RegionElement part_within(const Cone& cone, const Triangles& triangles) {
  RegionElement region;
  for (const auto& triangle : triangles) {
    ConvexPolygon polygon{std::span(triangle)};
    cone.clip(polygon);
    if (!polygon.empty())
      add_polygon(region, polygon);
  }
  return region;
}

/// By ElementId, 1 where fewer than four elements lie across a spot.
std::vector<std::uint8_t> under_narrow_spots(const ElementMesh& mesh, const Scene& scene,
                                             const WorldTree& worlds) {
  constexpr double wanted = 4.0;
  std::vector<std::uint8_t> marked(element_count(mesh), 0);
  tbb::parallel_for(std::size_t{0}, marked.size(), [&](std::size_t e) {
    const auto element = static_cast<ElementId>(e);
    const double size = size_of(mesh, element);
    marked[e] =
        std::ranges::any_of(narrow_spots(mesh, worlds, scene.lights, element),
                            [&](const SpotPart& part) { return part.width < wanted * size; });
  });
  return marked;
}

} // namespace

std::vector<SpotPart> narrow_spots(const ElementMesh& mesh, const WorldTree& worlds,
                                   std::span<const PunctualLight> lights, ElementId element) {
  std::vector<SpotPart> parts;
  const double widest = 16.0 * size_of(mesh, element);
  const auto is_spot = [](const PunctualLight& light) { return light.kind == PunctualKind::spot; };
  if (std::ranges::none_of(lights, is_spot))
    return parts;
  const Direction& normal = mesh.sides[index(mesh.side_of_element[index(element)])].normal;
  const Triangles triangles = triangles_of(mesh, element);
  const Sphere sphere = around(triangles);
  for (std::uint32_t w = 0; w < worlds.worlds.size(); ++w)
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      if (!is_spot(lights[k]))
        continue;
      const MirrorWorld& world = worlds.worlds[w];
      const Cone cone = cone_in(world, lights[k]);
      const double width = cone.width_at(sphere.centre);
      const double distance = cone.distance(sphere.centre);
      if (width > widest || distance > sphere.radius ||
          !(glm::dot(cone.apex - sphere.centre, normal) > 0.0) ||
          (world.depth > 0 && signed_distance(world.plane, cone.apex) >= 0.0))
        continue;
      SpotPart part{k,
                    static_cast<WorldId>(w),
                    2.0 * glm::distance(cone.apex, sphere.centre) * std::tan(cone.angle),
                    {}};
      if (distance > -sphere.radius) {
        part.lit = part_within(cone, triangles);
        if (part.lit.triangles.empty())
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
    const auto marked = under_narrow_spots(mesh, scene, worlds);
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
