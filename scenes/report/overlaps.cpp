#include "scenes/report/overlaps.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace meninas {
namespace {

// Among faces that all lie on one another all pairs are near ones; what is looked at ends there.
constexpr std::size_t max_overlaps_tried = 20'000'000;

/// A triangle in the coordinates of its plane.
struct FlatFace {
  TriangleId triangle = none<TriangleId>;
  std::array<Vec2, 3> corners{}; ///< counter-clockwise about the plane's normal
  Vec2 low{0.0}, high{0.0};
  bool forward = true; ///< its front is where the plane's normal points
};

FlatFace flat_face(const std::array<Point3, 3>& p, const TangentFrame& frame,
                   const Direction& normal) {
  FlatFace face;
  face.forward = glm::dot(area_vector(p), normal) >= 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    face.corners[face.forward ? k : 2 - k] = {glm::dot(p[k], frame.tangent),
                                              glm::dot(p[k], frame.bitangent)};
  }
  const auto& c = face.corners;
  face.low = glm::min(c[0], glm::min(c[1], c[2]));
  face.high = glm::max(c[0], glm::max(c[1], c[2]));
  return face;
}

std::vector<FlatFace> faces_of_plane(const Scene& scene, const Plane& plane,
                                     std::span<const TriangleId> triangles) {
  const TangentFrame frame = tangent_frame(plane.normal);
  std::vector<FlatFace> faces;
  for (const TriangleId triangle : triangles) {
    faces.push_back(flat_face(corners(scene, triangle), frame, plane.normal));
    faces.back().triangle = triangle;
  }
  std::ranges::sort(faces, [](const FlatFace& a, const FlatFace& b) {
    return std::pair(a.low.x, a.triangle) < std::pair(b.low.x, b.triangle);
  });
  return faces;
}

/// Whether no side of `a` has all of `b` outside, or within `depth` of it.
bool reaches_into(const FlatFace& a, const FlatFace& b, double depth) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 along = a.corners[(k + 1) % 3] - a.corners[k];
    const Vec2 inwards = Vec2(-along.y, along.x) / glm::length(along);
    double deepest = -1.0;
    for (const Vec2& x : b.corners) {
      deepest = std::max(deepest, glm::dot(x - a.corners[k], inwards));
    }
    if (deepest <= depth) {
      return false;
    }
  }
  return true;
}

bool has_same_corners(const FlatFace& a, const FlatFace& b, double tolerance) {
  return std::ranges::all_of(a.corners, [&](const Vec2& x) {
    return std::ranges::any_of(b.corners,
                               [&](const Vec2& y) { return glm::distance(x, y) <= tolerance; });
  });
}

bool show_the_same_way(const Scene& scene, const FlatFace& a, const FlatFace& b) {
  return a.forward == b.forward || material_of(scene, a.triangle).double_sided ||
         material_of(scene, b.triangle).double_sided;
}

} // namespace

bool overlap_along(const Direction& normal, const std::array<Point3, 3>& a,
                   const std::array<Point3, 3>& b, double depth) {
  const TangentFrame frame = tangent_frame(normal);
  const Point3& origin = a[0];
  const auto flat = [&](std::array<Point3, 3> p) {
    for (Point3& corner : p) {
      corner -= origin;
    }
    return flat_face(p, frame, normal);
  };
  const FlatFace one = flat(a), other = flat(b);
  return reaches_into(one, other, depth) && reaches_into(other, one, depth);
}

/// Triangles of one material do not count as overlapping.
static bool have_one_material(const Scene& scene, std::span<const TriangleId> triangles) {
  return std::ranges::all_of(triangles, [&](TriangleId t) {
    return scene.triangles[index(t)].material == scene.triangles[index(triangles[0])].material;
  });
}

CountByNodes overlapping_faces(const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<std::vector<TriangleId>> in_plane(surfaces.planes.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    in_plane[index(surfaces.plane_of_triangle[t])].push_back(TriangleId{t});
  }
  const auto overlap = [&](const FlatFace& a, const FlatFace& b) {
    const double depth = 4.0 * std::max(surface_of(surfaces, a.triangle).tolerance,
                                        surface_of(surfaces, b.triangle).tolerance);
    return scene.triangles[index(a.triangle)].material !=
               scene.triangles[index(b.triangle)].material &&
           a.low.y < b.high.y && b.low.y < a.high.y && show_the_same_way(scene, a, b) &&
           reaches_into(a, b, depth) && reaches_into(b, a, depth) && !has_same_corners(a, b, depth);
  };
  std::size_t tried = 0;
  std::set<std::tuple<NodeId, NodeId, TriangleId>> found;
  for (std::size_t plane = 0; plane < in_plane.size(); ++plane) {
    if (have_one_material(scene, in_plane[plane])) {
      continue;
    }
    const auto faces = faces_of_plane(scene, surfaces.planes[plane], in_plane[plane]);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      for (std::size_t other = k + 1;
           other < faces.size() && faces[other].low.x < faces[k].high.x && tried < max_overlaps_tried;
           ++other, ++tried) {
        if (overlap(faces[k], faces[other])) {
          const auto [first, second] = std::minmax(faces[k].triangle, faces[other].triangle);
          found.emplace(scene.triangles[index(first)].node, scene.triangles[index(second)].node,
                        first);
        }
      }
    }
  }
  CountByNodes counts;
  for (const auto& [node, other, face] : found) {
    ++counts[{node, other}];
  }
  return counts;
}

} // namespace meninas
