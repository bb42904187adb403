// The cones from a point x through the visible parts of the mirror worlds' windows,
// and how much of a sphere lies within one of them and behind the last mirror.
//
// A cone is bounded by the planes through x and the edges of an opening, with unit normals inwards:
// a sphere around c of radius r lies inside where n . (c - x) >= r for all of them.
#pragma once

#include "mirror/virtual_lights.h"

namespace meninas {

/// The place of a sphere against a half-space, or against an intersection of several: the least of theirs.
enum class Where : std::uint8_t { outside, partly, inside };

inline Where where(double distance_inwards, double radius) {
  return distance_inwards <= -radius ? Where::outside
                                     : (distance_inwards < radius ? Where::partly : Where::inside);
}

struct WindowCones {
  std::vector<Direction> sides;    ///< unit normals inwards
  std::vector<std::uint32_t> ends; ///< by opening, in `sides`
};

/// Clears and fills `cones`, whose storage is reused from point to point.
void find_cones(const SeenWorlds& seen, const Point3& x, WindowCones& cones);

/// Where a sphere of a world's unfolded space lies, around x + to: the most that one opening shows.
Where where_in_window(const WindowCones& cones, const MirrorWorld& world, const SeenWorld& seen,
                      const Point3& x, const Vec3& to, double radius);

} // namespace meninas
