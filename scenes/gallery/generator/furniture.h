// Things that stand in several rooms.
#pragma once

#include "scenes/gallery/generator/shapes.h"

namespace meninas::gallery {

/// The six walls of a closed room, named floor, ceiling, left (x0),
/// right (x1), back (z0) and front (z1), without `open`.
void add_room(Stage& stage, const Point3& low, const Point3& high, const Paint& paint,
              const Paint& floor, std::span<const Face> open = {});

/// A top on four legs; `low` and `high` bound it, `low.y` is the floor.
Mesh table(const Point3& low, const Point3& high, double thickness, double leg);

Mesh ball(const Point3& centre, double radius, int sides);

/// A slab about `centre` with the face towards -x left out, for a mirror;
/// both are turned about z by `degrees`.
struct TiltedMirror {
  Point3 centre;
  double half_length = 0.4;
  double half_width = 0.3;
  double degrees = 45.0;
};
void add_tilted_mirror(Stage& stage, const std::string& name, const TiltedMirror& tilted,
                       const Paint& glass, const Paint& back);

} // namespace meninas::gallery
