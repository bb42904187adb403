// Growing plane regions across the edges of a triangle soup, and telling which of them lie in one plane.
// (Used by find_surfaces alone.)
#pragma once

#include "scenes/surfaces.h"
#include "scenes/topology.h"

namespace meninas {

/// What the precision of its corners allows a triangle to say about its plane.
struct TriangleShape {
  Direction normal{0.0, 1.0, 0.0};
  double area = 0.0;
  double height = 0.0; ///< the smallest one
};

TriangleShape shape_of(const std::array<Point3, 3>& corners);

/// A connected set of triangles of one material and one front whose vertices are all within tolerance of the plane.
struct Region {
  Plane plane;
  double area = 0.0;
  std::vector<TriangleId> triangles; ///< ascending
};

/// Every triangle is in exactly one region; regions are in the order of their first triangles.
std::vector<Region> grow_regions(const Scene& scene, const std::vector<TriangleShape>& shapes,
                                 const Topology& topology, double tolerance);

struct PlaneClasses {
  std::vector<Plane> planes;
  std::vector<PlaneId> of_region;
};

/// Regions whose vertices are all within tolerance of one plane, whichever way they face, are one class.
PlaneClasses classify_planes(const Scene& scene, const std::vector<Region>& regions, double tolerance);

} // namespace meninas
