// Rooms that several tests light.
#pragma once

#include "scenes/surfaces/surfaces.h"
#include "tests/support/scene_builder.h"

namespace meninas::test {

/// Six equal walls of the unit cube but for those that are perfect mirrors;
/// every wall glows with E = 1.
Scene furnace(double reflectance, const std::array<bool, 6>& mirrors, Point3 size = Point3(1.0));

/// A room 2 x 2.4 x 3 m with walls of three colours,
/// a lamp under the ceiling and a box on the floor. Its wall x = 0 is a perfect mirror.
Scene half_room();

/// The same, but the mirror is a part of that wall, off its centre.
Scene half_room_with_small_mirror();

/// The method of images: every mirror is taken out, which leaves an opening,
/// and everything else is there once more, reflected in the plane of the first mirror found.
/// Polygons of the original come first and keep their names; images are called NAME.image.
Scene doubled(const Scene& half);

/// Two facing mirrors at z = 0 and z = 1, black walls,
/// and a lamp of radiance 1 under the ceiling half way between them.
Scene facing_mirrors(Rgb reflectance);

} // namespace meninas::test
