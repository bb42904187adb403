// Closed shells of a scene, and whether they show their fronts or their backs.
// (Part of report_scene.)
//
// A shell is a set of faces connected by edges that exactly two of them share. It is closed when no
// edge has less, and oriented when neighbours run along their common edge in opposite directions.
// The volume sum of a . (b x c) / 6 of a closed oriented shell is positive when its fronts are
// outside: a solid; and negative when they are inside: a room, or a solid that is inside out.
#pragma once

#include "scenes/surfaces/surfaces.h"
#include "scenes/surfaces/topology.h"

namespace meninas {

struct Shell {
  std::vector<TriangleId> faces;
  Bounds bounds;
  double volume = 0.0; ///< 0 unless closed and oriented
  double outwards =
      0.0; ///< mean cosine between fronts and the way out from the middle, weighted by area and distance
  std::size_t clashes =
      0; ///< edges whose two faces, of one node, run the same way: one of them is turned round
  bool oriented = true; ///< no edge is run the same way twice
  bool closed = true;
  bool double_sided = false; ///< some face is, so that turning matters less
};

/// The signed solid angle of a triangle from x, sr: positive from behind its front
/// (Van Oosterom and Strackee 1983).
double solid_angle(const std::array<Point3, 3>& triangle, const Point3& x);

std::vector<Shell> find_shells(const Scene& scene, const Topology& topology);

/// The winding number of the shell about the point, seen from its fronts, 1/4pi sum of the solid angles of its
/// faces: 1 inside a solid, -1 inside a room, 0 outside.
double winding_number(const Scene& scene, const Shell& shell, const Point3& x);

} // namespace meninas
