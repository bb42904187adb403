// Virtual lights: an emitter and its images in the mirror worlds, as seen from one point.
//
// From x, the image T_w e of an emitter counts only where the straight segment
// to it crosses the windows of m1 ... mk in order. The tree is walked from x:
// the part of each window that x sees through the part of the window before (polygon
// clipped to the cone) opens the next world, and an empty part closes the whole branch.
// An image is then cut by the receiver's horizon, by the last mirror's plane (what pierces
// a mirror ends there) and by the cone through the visible part of the last window:
//
//   V_0 = everything,   V_k = W_k in cone(x, V_k-1),   image = T_w e in cone(x, V_k)      (lengths in metres)
//
// with W_k the k-th window in unfolded space.
// Occluders are left out of this: shadow rays find them (radiosity/light/virtual_light_visibility.h).
#pragma once

#include "mirror/emitters.h"
#include "mirror/worlds.h"
#include "scenes/rays/ray_scene.h"

#include <span>
#include <vector>

namespace meninas {

/// The visible part of an emitter's image: convex, in unfolded space.
struct VirtualLight {
  std::uint32_t emitter = 0; ///< index into the emitters
  WorldId world = real_world;
  ConvexPolygon polygon;
  Direction normal;    ///< of the image, towards the observer
  double weight = 1.0; ///< how many times it counts, where it stands for others (light_choice.h)
  double afar = 0.0; ///< above 0: F of a group that it stands for, as if of its own radiosity

  bool stands_for_others() const { return weight > 1.0 || afar > 0.0; }
};

/// A point on a surface that sees virtual lights. A point within `tolerance` of an emitter's plane sees
/// nothing of it: there, rounding would decide between nothing and all of the hemisphere.
struct Observer {
  Point3 position;
  Direction normal;
  double tolerance = 0.0;
};

/// The worlds an observer looks into, depth first, each with the visible parts of its window:
/// openings first to last - 1.
struct SeenWorld {
  WorldId world = real_world;
  std::uint32_t first = 0, last = 0;
};
struct SeenWorlds {
  std::vector<SeenWorld> worlds;
  std::vector<ConvexPolygon> openings;
  std::vector<ViewCone> cones; ///< by opening, from the observer

  void clear() {
    worlds.clear();
    openings.clear();
    cones.clear();
  }
  void add_opening(const Observer& observer, const ConvexPolygon& opening) {
    openings.push_back(opening);
    cones.push_back(view_cone(observer.position, opening));
  }
};

/// Appends the parts of a world's window that x sees through the visible parts of its parent's.
void add_openings(const MirrorWorld& world, const Observer& observer, const SeenWorld& parent,
                  SeenWorlds& seen);

/// Clears and fills `seen`, whose storage is reused from call to call.
void seen_worlds(const WorldTree& tree, const Observer& observer, SeenWorlds& seen);

/// One world of a tree as an observer sees it.
struct WorldSight {
  const WorldTree& tree;
  const SeenWorlds& seen;
  const SeenWorld& at; ///< of `seen`
  const Observer& observer;
};

/// Appends the parts of the image of one emitter in that world.
void add_images(const WorldSight& sight, std::span<const Emitter> emitters, std::uint32_t emitter,
                double weight, std::vector<VirtualLight>& lights);

/// Appends the image of one emitter in a world to whose observer nothing of it is hidden.
void add_whole_image(const WorldTree& tree, std::span<const Emitter> emitters, WorldId world,
                     std::uint32_t emitter, std::vector<VirtualLight>& lights);

/// Appends the images of all emitters in all seen worlds.
void all_lights(const WorldTree& tree, std::span<const Emitter> emitters, const SeenWorlds& seen,
                const Observer& observer, std::vector<VirtualLight>& lights);

/// All parts of all emitters' images in all worlds of the tree
/// that x sees above the horizon of `normal`, blockers aside.
/// Clears and fills `lights`, whose storage is reused from call to call.
void virtual_lights(const WorldTree& tree, std::span<const Emitter> emitters, const Point3& x,
                    const Direction& normal, double tolerance, std::vector<VirtualLight>& lights);

/// Folds `whole`, the segment from a point to one of unfolded space in world w, back into real
/// legs, first one first.
/// Every leg names the planes it leaves and reaches; k + 1 legs for a chain of k mirrors.
void fold_legs(const WorldTree& tree, const MirrorSet& mirrors, WorldId world, const Leg& whole,
               std::vector<Leg>& legs);

} // namespace meninas
