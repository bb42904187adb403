#include "scenes/report/crossings.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

constexpr double drawn_inwards = 0.01;
constexpr double min_depth = 1e-3; ///< of the segment's length
constexpr double min_weight = 5e-3; ///< of the corners at the hit: at an edge things only touch

/// The triangle that the segment passes through, if its first hit is one.
TriangleId crossed(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                   TriangleId from, const Point3& a, const Point3& b) {
  const double length = glm::distance(a, b);
  const PlaneId leaving = surfaces.plane_of_triangle[index(from)];
  const auto hit = closest_hit(rays, {a, (b - a) / length, leaving, length});
  if (!hit) {
    return none<TriangleId>;
  }
  const auto [b1, b2] = std::pair(hit->barycentric.x, hit->barycentric.y);
  if (std::min({b1, b2, 1.0 - b1 - b2}) < min_weight) {
    return none<TriangleId>;
  }
  const auto p = corners(scene, hit->triangle);
  const Direction normal = glm::normalize(area_vector(p));
  const double before = glm::dot(a - p[0], normal);
  const double behind = glm::dot(b - p[0], normal);
  const double depth = std::min(std::abs(before), std::abs(behind));
  const double tolerance = std::max(surface_of(surfaces, from).tolerance,
                                    surface_of(surfaces, hit->triangle).tolerance);
  const bool passes = (before > 0.0) != (behind > 0.0) &&
                      depth > std::max(4.0 * tolerance, min_depth * length);
  return passes ? hit->triangle : none<TriangleId>;
}

} // namespace

CountByNodes crossings(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays) {
  const std::size_t count = scene.triangles.size();
  std::vector<std::array<TriangleId, 3>> found(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    const TriangleId triangle{static_cast<std::uint32_t>(t)};
    auto p = corners(scene, triangle);
    const Point3 middle = (p[0] + p[1] + p[2]) / 3.0;
    for (Point3& corner : p) {
      corner = glm::mix(corner, middle, drawn_inwards);
    }
    for (std::size_t side = 0; side < 3; ++side) {
      found[t][side] =
          crossed(scene, surfaces, rays, triangle, p[side], p[(side + 1) % 3]);
    }
  });
  CountByNodes counts;
  for (std::size_t t = 0; t < count; ++t) {
    for (const TriangleId other : found[t]) {
      if (other != none<TriangleId>) {
        const auto nodes =
            std::minmax(scene.triangles[t].node, scene.triangles[index(other)].node);
        ++counts[nodes];
      }
    }
  }
  return counts;
}

} // namespace meninas
