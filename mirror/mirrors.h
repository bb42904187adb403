// The planar mirrors of a scene:
// coplanar ideal-mirror surfaces of one reflectance merged into one mirror each.
//
//   R_m x = x - 2 (n.x - d) n,   rho the reflectance (dimensionless), of glass and coats 2 int_0^1 R(c) c dc
//
// A mirror's window is the set of convex polygons through which its mirror world is seen.
// The front of a mirror reflects; a double-sided mirror is two mirrors, back to back.
// Curved mirrors are many small planes: beyond `max_mirrors` planes only large ones are enumerated,
// the rest are facets, which rays follow exactly all the same but which get no mirror world.
// Where the file gives normals that turn (scenes/shading_normal.h) all planes are facets.
//
// Glass is a mirror on either side whose reflectance depends on the angle (scenes/materials/glass.h),
// and so is the coat of a polished floor on its front (scenes/materials/smooth_surfaces.h):
// the reflectance here is the mean over all angles, by which their worlds are judged.
// Solids have none, rays alone follow what they reflect. Code that follows a path takes the exact
// reflectance from the glass or coat. Coats are enumerated last, so they displace no mirror.
// Planes of theirs that are small beside the scene, as the edge of a table top is, are facets.
#pragma once

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/surfaces.h"

#include <string>
#include <vector>

namespace meninas {

enum class MirrorId : std::uint32_t {};

struct MirrorSettings {
  int max_mirrors = 64; ///< planes that may be enumerated
  double smallest_share =
      0.01; ///< of the mirrors' total area, asked of each once there are more planes than that
};

struct Mirror {
  Plane plane; ///< normal towards the reflecting side
  PlaneId plane_class = none<PlaneId>;
  Rgb reflectance{1.0};
  MaterialId by_angle =
      none<MaterialId>; ///< glass or coated; none: a mirror of constant reflectance
  bool is_coat = false;
  bool has_width =
      false; ///< what is seen in it is blurred or bumpy: an ideal mirror only to the surfaces that it throws light on
  double area = 0.0;
  std::vector<ConvexPolygon>
      window; ///< convex, disjoint, counter-clockwise seen from the reflecting side
  std::vector<NodeId> nodes;
};

struct MirrorSet {
  std::vector<Mirror> mirrors; ///< largest first, coats behind all others
  std::vector<std::array<MirrorId, 2>>
      mirror_of_surface; ///< by SurfaceId, for its front and its back; none for facets and the rest
  std::size_t facets = 0; ///< mirror surfaces that are not enumerated
};

MirrorSet find_mirrors(const Scene& scene, const SurfaceModel& surfaces,
                       const MirrorSettings& settings = {});

} // namespace meninas
