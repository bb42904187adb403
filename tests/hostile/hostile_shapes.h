// Bodies as no one should model them and as people do: nearly nothing, nearly flat, on top of one
// another, and by the hundred.
//
// A seed is the same scene whatever compiled it: compilers differ in the order in which they evaluate the arguments
// of a call and the operands of + and *, so no two of these draw a number. In braces they go from left to right.
#pragma once

#include "tests/support/random.h"

#include <vector>

namespace meninas::test {

/// Points and, three by three, the corners of triangles.
struct Shape {
  std::vector<Point3> points;
  std::vector<std::uint32_t> corners;

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    corners.insert(corners.end(), {a, b, c});
  }
  /// A fan about the first point of a polygon, as exporters triangulate it.
  void add_fan(const std::vector<Point3>& polygon);
  void add(const Shape& other);
};

/// One of many kinds, about 1 m large, in a place of its own.
Shape hostile_shape(Random& random);

/// A box from `low` to `high`, its fronts towards the inside or the outside.
Shape box(Point3 low, Point3 high, bool inwards);

/// One of 10^low ... 10^high.
double power_of_ten(Random& random, double low, double high);

/// In any direction, one of 10^low ... 10^high long.
Vec3 offset_of_any_size(Random& random, double low, double high);

/// Below `count`.
std::uint32_t choose(Random& random, std::uint32_t count);

inline bool happens(Random& random, double chance) { return random.between(0.0, 1.0) < chance; }

} // namespace meninas::test
