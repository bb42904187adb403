// Triangulations of a part of a plane, made well shaped by flips and points inside.
// (Used by retriangulation.cpp alone.)
//
// Edges of one triangle alone are the outline: they stay as they are.
// Across the others triangles are flipped until each has no vertex of a neighbour
// within its circumcircle (Lawson 1977): the constrained Delaunay triangulation.
// Triangles that are then still much longer than wide get a new vertex at their circumcentre,
// the worst ones first (Ruppert 1995), where the triangles then take a tenth less in all, and unless
// that lies beyond the outline or within the circle about an edge of it: the outline is not cut.
#pragma once

#include "scenes/types.h"

#include <array>
#include <vector>

namespace meninas {

struct PlaneTriangle {
  static constexpr std::uint32_t outline = 0xffffffffU;

  std::array<std::uint32_t, 3> corners{};    ///< counter-clockwise
  std::array<std::uint32_t, 3> neighbours{}; ///< across the edges from corner k to k + 1
};

struct PlaneMesh {
  std::vector<Vec2> points;
  std::vector<PlaneTriangle> triangles;
};

/// The area that squares on the longest edges would cover, half of it for triangles with a right
/// angle: how many elements a triangle takes, in units of their area.
double wanted_area(const PlaneMesh& mesh, const PlaneTriangle& triangle);

/// Flips edges until the triangulation is Delaunay.
void make_delaunay(PlaneMesh& mesh);

/// Adds points where a triangle takes more than three times its area, as far as that saves elements,
/// until there are `max_points`. Expects a Delaunay triangulation.
void refine(PlaneMesh& mesh, std::size_t max_points);

} // namespace meninas
