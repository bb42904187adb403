// Virtual lights: an emitter and its images in the mirror worlds, as seen from one point.
//
// From x, the image T_w e of an emitter counts only where the straight segment to it crosses the windows of m1 ... mk in order. The
// tree is walked from x: the part of each window that x sees through the part of the window before (polygon clipped to the cone) opens
// the next world, and an empty part closes the whole branch. An image is then cut by the receiver's horizon, by the last mirror's
// plane (what pierces a mirror ends there) and by the cone through the visible part of the last window.
#pragma once

#include "mirror/worlds.h"
#include "scenes/ray_scene.h"

#include <span>
#include <vector>

namespace meninas {

/// One emitting face: the front or the back of a patch.
struct Emitter {
  ConvexPolygon polygon; ///< counter-clockwise seen from the side that emits
  Plane plane;           ///< normal towards that side
  PlaneId plane_class = none<PlaneId>;
  Rgb radiosity{0.0}; ///< E = pi L
  double area = 0.0;
};

/// The visible part of an emitter's image: convex, in unfolded space.
struct VirtualLight {
  std::uint32_t emitter = 0; ///< index into the emitters
  WorldId world = real_world;
  ConvexPolygon polygon;
  Direction normal; ///< of the image, towards the observer
};

/// All parts of all emitters' images in all worlds of the tree that x sees above the horizon of `normal`, blockers aside.
/// A point within `tolerance` of an emitter's plane sees nothing of it: there, rounding would decide between nothing and all of the
/// hemisphere. Clears and fills `lights`, whose storage is reused from call to call.
void virtual_lights(const WorldTree& tree, std::span<const Emitter> emitters, const Point3& x,
                    const Direction& normal, double tolerance, std::vector<VirtualLight>& lights);

/// Folds the segment from x to the point y of unfolded space in world w back into real legs, first one first.
/// Every leg names the planes it leaves and reaches; k + 1 legs for a chain of k mirrors.
void fold_legs(const WorldTree& tree, const MirrorSet& mirrors, WorldId world, const Point3& x,
               PlaneId leaving, const Point3& y, PlaneId arriving, std::vector<Leg>& legs);

} // namespace meninas
