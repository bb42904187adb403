// Where things stand on surfaces: the segments along which faces touch or cross a side, by geometry.
//
// They are the D0 discontinuity edges of Heckbert 1992 and of Lischinski, Tampieri and Greenberg 1992:
// across them radiosity jumps, as what is lit on one side of a wall may be dark on the other.
// Cells of the mesh are cut along them (cut_cells.h).
//
// A face stands on a side where it crosses its plane, or where an edge of it lies in the plane or
// hovers at most a sixteenth of an element above it. A face this close separates the light as a touching
// one does. For a face parallel to the side its outline is used. Panes are ignored.
// Faces in the plane itself have no segment; the sides of what lies there do.
//
// Limits: sides smaller than a sixteenth of an element either way are not looked at.
#pragma once

#include "radiosity/mesh/cut_polygon.h"
#include "radiosity/mesh/element_mesh.h"

namespace meninas {

struct ContactSegment {
  Segment2 at;        ///< in the coordinates of plane_place(), metres
  double reach = 0.0; ///< how far the run of segments extends to which it belongs, metres
};

/// By the root cells of a mesh, in the order of their numbers.
struct ContactSegments {
  std::vector<ContactSegment> segments;
  std::vector<std::uint32_t> begin;   ///< root cells + 1
  std::vector<std::uint32_t> in_cell; ///< numbers of segments that may touch the cell
};

/// Coordinates in the plane of a side: along its tangent, and across.
struct PlanePlace {
  Point3 origin;
  Vec3 along, across;
  explicit PlanePlace(const Patch& patch, const MeshSide& side)
      : origin(patch.corners[0]), along(side.tangent),
        across(glm::cross(side.normal, side.tangent)) {}
  Vec2 operator()(const Point3& x) const {
    return {glm::dot(x - origin, along), glm::dot(x - origin, across)};
  }
  Point3 at(Vec2 place) const { return origin + place.x * along + place.y * across; }
};

/// For the root cells of a mesh.
ContactSegments find_contact_segments(const Scene& scene, const SurfaceModel& surfaces,
                                      const ElementMesh& mesh);

} // namespace meninas
