// The things that stand in the living room; each adds parts to the stage, named after it.
// Nothing passes through anything else: what touches is a millimetre or less apart.
#pragma once

#include "scenes/gallery/living_room/smooth_shapes.h"

namespace meninas::gallery {

/// Paints that several things share.
Paint textured(const std::string& name, Picture picture, const Rgb& factor = Rgb(1.0));
Paint wood();
Paint dark_wood();
Paint porcelain();

/// Where a thing stands, and by how much it is turned from facing +z towards +x.
struct Place {
  Point3 foot;
  double degrees = 0.0;
};
Mesh placed(Mesh mesh, const Place& place);

/// A sofa or an armchair: `cushions` side by side, each 0.58 m wide.
struct Seat {
  std::string name;
  int cushions = 3;
  Rgb cloth{0.5};
  bool pillows = true;
};
void add_seat(Stage& stage, const Seat& seat, const Place& place);

/// A case of six shelves, 1.3 m wide, 2.15 m high, with some 290 books.
void add_bookcase(Stage& stage, const std::string& name, const Place& place, std::uint64_t seed);

/// A round table on four turned legs, with a tea set and a vase of flowers.
void add_tea_table(Stage& stage, const Place& place);

/// A pot with `leaves` leaves on bowed stems.
void add_plant(Stage& stage, const Place& place, int leaves);

/// A framed mirror on two turned posts.
void add_standing_mirror(Stage& stage, const Place& place);

/// A shade of cloth on a post, and the bulb in it.
void add_floor_lamp(Stage& stage, const Place& place);

/// A lantern that hangs from `hook`.
void add_lantern(Stage& stage, const Point3& hook);

/// Both halves of a pair before a window in the wall x = 0, between `from` and `to` along z.
void add_curtains(Stage& stage, double from, double to);

} // namespace meninas::gallery
