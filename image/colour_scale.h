// The scale of a picture in false colours: a title, a bar of the colours, and numbers below it, drawn
// over a strip of the picture.
#pragma once

#include "image/channel.h"
#include "image/image.h"

#include <string>

namespace meninas {

enum class ErrorScale {
  magnitude, ///< 0 .. top, in magma
  signed_    ///< -top .. top, blue below zero and orange above
};

struct ColourScale {
  std::string title; ///< drawn above the scale
  double top = 1.0;  ///< the value of the brightest colour, positive; larger ones look the same
  ErrorScale scale = ErrorScale::magnitude;
};

/// A scale that ends in 1, 2 or 5 times a power of ten and shows at least 99.5 % of the values,
/// whatever their sign; 1 if all are 0.
double readable_top(const Channel& values);

/// Linear; `place` is 0 at the scale's low end and 1 at its top.
glm::vec3 scale_colour(double place, ErrorScale scale);

/// The value at its low end.
double scale_start(const ColourScale& scale);

/// The colour under scales and beside maps: a dark grey, linear.
glm::vec3 scale_background();

/// The pixels from (x0, y0) to before (x1, y1) that are in the picture.
void fill(Image& picture, int x0, int y0, int x1, int y1, const glm::vec3& colour);

/// The number of steps between the numbers below the bar.
int scale_ticks(ErrorScale scale);

/// The height of the strip, pixels; letters have dots of at most `largest_dot`.
int scale_height(int width, const ColourScale& scale, int largest_dot);

/// Draws the strip with `y` as its upper edge, over what is there.
void draw_scale(Image& picture, int y, const ColourScale& scale, int largest_dot);

/// A picture of the values: magma from 0 to the top, black where there is none (`known` is 0), lines
/// along each tenth of the scale where the values are smooth, and the scale over its lowest rows, where
/// the picture is large enough to read it. Linear, to be shown without exposure.
Image false_colours(const Channel& values, const Channel& known, const ColourScale& scale);

} // namespace meninas
