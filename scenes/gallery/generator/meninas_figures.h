// The people of the painter's room:
// low-poly turned shapes in coloured gowns, meant to be read at a distance.
#pragma once

#include "scenes/gallery/generator/shapes.h"

namespace meninas::gallery {

/// Which way along z someone looks.
enum class Gaze { front, rear };

enum class Dress { wide_skirt, skirt, cloak };

struct Figure {
  std::string name;
  Point3 foot;
  double height = 1.6;
  Dress dress = Dress::skirt;
  Rgb gown{0.5};
  Rgb hair{0.2};
  Gaze gaze = Gaze::front;
};

/// Adds NAME.gown, NAME.head and NAME.hair.
void add_figure(Stage& stage, const Figure& figure);

/// Arms as bars from the shoulders to two hands.
void add_arms(Stage& stage, const Figure& figure, const Point3& left_hand,
              const Point3& right_hand);

/// A dog that lies along x, its head towards -x.
void add_dog(Stage& stage, const Point3& foot);

} // namespace meninas::gallery
