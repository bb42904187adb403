#include "scenes/rays/mixed_scales.h"

#include "scenes/rays/careful_rays.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meninas {

namespace {

/// A patch and what is so close before its middle that rays take them for touching.
struct LostGap {
  NodeId node = none<NodeId>, other = none<NodeId>;
  double width = std::numeric_limits<double>::infinity();
};

/// Whether a triangle is off a plane, before it, or behind it if that side counts as well:
/// what continues the surface or stands on it leaves no gap.
bool hovers(const Scene& scene, TriangleId triangle, const Plane& plane, double known,
            bool both_sides) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point3& corner : corners(scene, triangle)) {
    low = std::min(low, signed_distance(plane, corner));
    high = std::max(high, signed_distance(plane, corner));
  }
  return low > known || (both_sides && high < -known);
}

LostGap gap_before(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                   const Patch& patch) {
  // A gap of a few times what counts as contact is still known to no more than a part of itself.
  constexpr double doubtful = 4e-6;
  const Surface& surface = surfaces.surfaces[index(patch.surface)];
  const Point3 middle =
      point_at(patch, patch.corner_count == 4 ? Vec2(0.5, 0.5) : Vec2(1.0 / 3.0, 1.0 / 3.0));
  const glm::vec3 origin(to_frame(rays.frame(), middle));
  LostGap gap;
  for (const ContactTriangle& contact :
       contacts_of(rays, origin, index(surface.plane_class), doubtful).others) {
    const double width = distance_to(corners(scene, contact.triangle), middle);
    const double known =
        std::max(surface.tolerance, surface_of(surfaces, contact.triangle).tolerance);
    const bool both = scene.materials[index(patch.material)].double_sided;
    if (width > known && width < gap.width &&
        hovers(scene, contact.triangle, surface.plane, known, both))
      gap = {patch.node, scene.triangles[index(contact.triangle)].node, width};
  }
  return gap;
}

LostGap narrowest_gap(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays) {
  // Of more patches than that every so manyth is asked.
  constexpr std::size_t max_patches = 100'000;
  const std::size_t stride = surfaces.patches.size() / max_patches + 1;
  std::vector<LostGap> gaps((surfaces.patches.size() + stride - 1) / stride);
  tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t k) {
    gaps[k] = gap_before(scene, surfaces, rays, surfaces.patches[k * stride]);
  });
  const auto narrowest = std::ranges::min_element(gaps, {}, &LostGap::width);
  return narrowest == gaps.end() ? LostGap{} : *narrowest;
}

/// How far the plane of a triangle that reaches beyond the detail may be off within it:
/// each corner by half a unit in the last place of its coordinates, and the arithmetic
/// of the query by as much again for each of them.
double offset_of(const FrameGeometry& geometry, std::uint32_t triangle) {
  constexpr double rounding = 4.0 * 6e-8;
  const auto corners = corners_of(geometry, triangle);
  const Vec3 normal = glm::abs(geometry.plane_normals[geometry.facts[triangle].plane]);
  double largest = 0.0;
  for (const Point3& corner : corners)
    largest = std::max(largest, glm::dot(normal, glm::abs(corner)));
  return rounding * largest;
}

/// The face that is off by most, if that is worth a word.
std::optional<std::string> slanted_face(const Scene& scene, const FrameGeometry& geometry) {
  constexpr double visible = 1e-3; // of the detail
  if (geometry.detail >= 1.0F)
    return std::nullopt;
  const double detail{geometry.detail};
  double most = visible * detail;
  std::optional<std::uint32_t> found;
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const double offset = offset_of(geometry, t);
    if (offset > most && is_within(corners_of(geometry, t), Point3(0.0), 2.0 * detail)) {
      most = offset;
      found = t;
    }
  }
  if (!found)
    return std::nullopt;
  const Triangle& triangle = scene.triangles[*found];
  return fmt::format("'{}' passes the detail of a scene that is {:.2g} times as wide: rays, which "
                     "are floats, know its place there to {:.2g} m; divide it, or make it smaller",
                     scene.nodes[index(triangle.node)].name, 1.0 / detail,
                     most / geometry.frame.scale);
}

} // namespace

std::vector<std::string> warnings_of_merged_planes(const Scene& scene,
                                                   const SurfaceModel& surfaces) {
  // Programs round more coarsely than their files tell; so much more is a gap.
  constexpr double clearly = 64.0;
  const Precision precision(scene);
  double widest = 0.0, known = 0.0;
  NodeId node = none<NodeId>;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const TriangleId triangle{t};
    double off = std::numeric_limits<double>::infinity();
    for (const Point3& corner : corners(scene, triangle))
      off = std::min(off, std::abs(signed_distance(
                              surfaces.planes[index(surfaces.plane_of_triangle[t])], corner)));
    if (off > widest && off > clearly * precision.alone(triangle)) {
      widest = off;
      known = 0.25 * surface_of(surfaces, triangle).tolerance;
      node = scene.triangles[t].node;
    }
  }
  if (node == none<NodeId>)
    return {};
  const Bounds bounds = bounds_of(scene);
  const double extent = glm::distance(bounds.low, bounds.high);
  return {fmt::format("'{}' counts as lying in one plane with another surface, though {:.2g} m off "
                      "it: in a scene {:.2g} times as wide corners are only known to {:.2g} m; "
                      "leave out what is far away",
                      scene.nodes[index(node)].name, widest, extent / widest, known)};
}

std::vector<std::string> warnings_of_mixed_scales(const Scene& scene, const SurfaceModel& surfaces,
                                                  const RayScene& rays) {
  std::vector<std::string> warnings = warnings_of_merged_planes(scene, surfaces);
  const LostGap gap = narrowest_gap(scene, surfaces, rays);
  if (gap.node != none<NodeId>)
    warnings.push_back(fmt::format(
        "'{}' and '{}' are {:.2g} m apart in a scene {:.2g} times as wide: rays, which are floats, "
        "take them for touching; leave out what is far away",
        scene.nodes[index(gap.node)].name, scene.nodes[index(gap.other)].name, gap.width,
        2.0 / (rays.frame().scale * gap.width)));
  if (auto slanted = slanted_face(scene, rays.geometry()))
    warnings.push_back(std::move(*slanted));
  return warnings;
}

} // namespace meninas
