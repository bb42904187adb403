// Growing plane regions across the edges of a triangle soup. (Used by find_surfaces, and by repairs.)
#pragma once

#include "scenes/surfaces/plane.h"
#include "scenes/surfaces/precision.h"
#include "scenes/surfaces/topology.h"

namespace meninas {

/// The knowledge of a triangle's plane that the precision of its corners allows.
struct TriangleShape {
  Direction normal{0.0, 1.0, 0.0};
  double area = 0.0;
  double height = 0.0; ///< the smallest one
};

TriangleShape shape_of(const std::array<Point3, 3>& corners);

/// A connected set of triangles of one material and one front whose vertices are all within
/// tolerance of the plane.
struct Region {
  Plane plane;
  double area = 0.0;
  double tolerance = 0.0;  ///< of the least known of its triangles
  std::uint32_t first = 0; ///< of its triangles in Regions::members
  std::uint32_t count = 0;
};

/// No triangle is in two regions; regions are in the order of their first triangles.
struct Regions {
  std::vector<Region> regions;
  std::vector<TriangleId> members; ///< the triangles of each region, ascending
};

inline std::span<const TriangleId> triangles_of(const Regions& regions, const Region& region) {
  return std::span(regions.members).subspan(region.first, region.count);
}

/// `tolerances` by triangle, in metres; a triangle of a negative one is in no region.
Regions grow_regions(const Scene& scene, const std::vector<TriangleShape>& shapes,
                     const Topology& topology, std::span<const double> tolerances);

} // namespace meninas
