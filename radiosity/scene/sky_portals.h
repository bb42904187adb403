// Openings through which a room is lit by the sky: panes of glass, and holes in its walls.
//
//   E = pi L   W/m^2 of an even sky; of another, L(d) in the direction in which a ray leaves
//
// An opening is an emitter of direct light (direct_irradiance.h): Lambert's closed form of its
// polygon, times what its shadow rays, which go on to beyond the scene, find there. The rays of
// the form factors leave out what escapes by an opening in an enumerated mirror world, and so no light
// counts twice. A ray that crosses several belongs to the last.
#pragma once

#include "mirror/emitters.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/surfaces/surfaces.h"

#include <span>
#include <vector>

namespace meninas {

/// An opening as it is seen from inside.
struct SkyPortal {
  ConvexPolygon polygon; ///< counter-clockwise seen from inside
  Plane plane;           ///< normal inwards
  PlaneId plane_class = none<PlaneId>;
  double area = 0.0;
};

/// The portals of a scene under a sky: openings that are open to it on one side only, at most half as large
/// as the area they light, about pi d^2 for rays that end after d metres; the 64 largest. The light of others, as
/// of a shelf or a pot's mouth, is gathered.
std::vector<SkyPortal> find_sky_portals(const Scene& scene, const SurfaceModel& surfaces,
                                        const RayScene& rays);

/// The least height above a portal's plane, metres, from which a ray can leave by it. A receiver sees nothing of an
/// emitter in whose plane it is (mirror/virtual_lights.h); a mirror there has sent light that came from inside.
constexpr double min_height(double tolerance, bool reflected) {
  return reflected ? -tolerance : tolerance;
}

/// The last of the portals by which a ray leaves from `origin`, where it has set out or was last
/// reflected; no_portal where it leaves by none.
std::uint32_t last_portal(std::span<const SkyPortal> portals, const Point3& origin,
                          const Vec3& direction, double min_height);

} // namespace meninas
