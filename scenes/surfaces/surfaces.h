// Surfaces and patches: the geometry as light sees it, rebuilt from a soup of triangles.
//
// A plane class (PlaneId) is a set of triangles in one plane, whichever way they face:
// a ray that leaves a plane cannot meet that plane again,
// which is how self-hits are excluded exactly, at any scale.
// A surface is a maximal connected coplanar set of triangles with one material and one front.
// A patch is a quad or a triangle of a surface with its own (u, v): two triangles of one node
// that share an edge and form a convex quad become one quad patch, the rest stay triangles.
//
// (u, v) of a quad patch with corners p0..p3 is the bilinear
// map p(u,v) = (1-u)(1-v) p0 + u(1-v) p1 + uv p2 + (1-u)v p3,
// of a triangle patch the affine map p(u,v) = p0 + u (p1 - p0) + v (p2 - p0), u + v <= 1.
#pragma once

#include "scenes/surfaces/plane.h"
#include "scenes/surfaces/precision.h"

#include <span>

namespace meninas {

struct Surface {
  Plane plane; ///< normal towards the front
  PlaneId plane_class = none<PlaneId>;
  MaterialId material = none<MaterialId>;
  double area = 0.0;
  double tolerance = 0.0; ///< distance in metres below which points count as in its plane
  std::vector<PatchId> patches;
};

struct Patch {
  SurfaceId surface = none<SurfaceId>;
  NodeId node = none<NodeId>;
  MaterialId material = none<MaterialId>;
  int corner_count = 3;                     ///< 3 or 4
  std::array<Point3, 4> corners{};          ///< counter-clockwise seen from the front; the fourth only of a quad
  std::array<VertexId, 4> vertices{};       ///< scene vertices at the corners
  std::array<TriangleId, 2> triangles{none<TriangleId>, none<TriangleId>};
  double area = 0.0;
  bool affine = true; ///< a triangle or a parallelogram: (u, v) is affine in the position
};

struct SurfaceModel {
  Detail detail; ///< of the scene
  std::vector<Surface> surfaces;
  std::vector<Patch> patches;
  std::vector<PatchId> patch_of_triangle;
  std::vector<PlaneId> plane_of_triangle;
  std::vector<Plane> planes;                     ///< a representative of each plane class
  std::vector<std::array<Vec2, 3>> corner_uv;    ///< per triangle, (u, v) of its three vertices in its patch
  double tolerance = 0.0;                        ///< that of all surfaces within the detail of the scene
};

SurfaceModel find_surfaces(const Scene& scene);

inline const Surface& surface_of(const SurfaceModel& model, TriangleId triangle) {
  const Patch& patch = model.patches[index(model.patch_of_triangle[index(triangle)])];
  return model.surfaces[index(patch.surface)];
}

inline std::span<const Point3> polygon_of(const Patch& patch) {
  return {patch.corners.data(), static_cast<std::size_t>(patch.corner_count)};
}

Point3 point_at(const Patch& patch, Vec2 uv);

/// (u, v) of the point with barycentric weights (1 - b1 - b2, b1, b2) on a triangle of the scene.
Vec2 patch_uv(const SurfaceModel& model, TriangleId triangle, Vec2 barycentric);

/// (u, v) of a point in the plane of a patch, clamped to the patch. Inverse of point_at.
Vec2 uv_at(const Patch& patch, const Point3& x);

} // namespace meninas
