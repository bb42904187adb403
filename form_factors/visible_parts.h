// The visible parts of a convex polygon from a point, past opaque convex blockers, exactly.
//
// A blocker hides its cone from the point. Convex minus convex is a set of disjoint convex pieces,
// one for each side of the cone the polygon reaches beyond. With h_i the inner half-spaces of the cone's sides,
//
//   P - cone = union over i of  P in h_1 in ... in h_i-1 outside h_i
//
// Subtracting blocker after blocker leaves the visible parts, whose form factors (dimensionless) add up.
// Blockers are to lie between the point and the polygon's plane: cut them there first.
#pragma once

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas {

/// Coplanar patches of one surface joined to a convex polygon; opaque from both sides.
struct Face {
  ConvexPolygon polygon; ///< counter-clockwise seen from the front
  Plane plane;
  PlaneId plane_class = none<PlaneId>;
  MaterialId material = none<MaterialId>;
  NodeId node = none<NodeId>;
  double area = 0.0;
  Point3 centre{0.0}; ///< of a sphere around it
  double radius = 0.0;
};

/// As few convex faces as joining whole edges gives. Patches of different nodes are not joined.
std::vector<Face> joined_faces(const SurfaceModel& surfaces);

/// Faces that together cover what those given do, each place once from each side: where several of
/// one plane class face the same way and overlap by more than the tolerance, the first there stays.
/// Rays meet one of them as well; counted twice, form factors in a closed room would exceed one.
std::vector<Face> without_overlaps(const std::vector<Face>& faces, double tolerance);

/// A face on which very many things stand is left to the integration.
inline constexpr std::size_t enough_parts_at_contacts = 256;

/// The face cut along the lines where others stand on it, unless it is in `max_parts` or more:
/// across them what is seen jumps, between them it changes steadily.
std::vector<ConvexPolygon> cut_at_contacts(const Face& face, const std::vector<Face>& others,
                                           double tolerance, std::size_t max_parts = enough_parts_at_contacts);

/// Splits the parts that the segment runs through, along the line it is on.
void cut_along(std::vector<ConvexPolygon>& parts, const Point3& from, const Point3& to,
               const Direction& front, double tolerance);

/// Takes the cone from x over the blocker out of every part. A blocker seen edge-on hides nothing.
void subtract_cone(std::vector<ConvexPolygon>& parts, const Point3& x,
                   const ConvexPolygon& blocker);

/// Whether no segment between the two polygons can meet the blocker:
/// a plane holds them apart. Errs towards "no".
bool holds_apart(const ConvexPolygon& a, const ConvexPolygon& b, const ConvexPolygon& blocker,
                 double tolerance);

} // namespace meninas
