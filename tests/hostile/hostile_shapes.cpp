#include "tests/hostile/hostile_shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace meninas::test {

void Shape::add_fan(const std::vector<Point3>& polygon) {
  const auto first = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), polygon.begin(), polygon.end());
  for (std::uint32_t k = 2; k < polygon.size(); ++k)
    add_triangle(first, first + k - 1, first + k);
}

void Shape::add(const Shape& other) {
  const auto first = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t corner : other.corners)
    corners.push_back(first + corner);
}

double power_of_ten(Random& random, double low, double high) {
  return std::pow(10.0, random.between(low, high));
}

Vec3 offset_of_any_size(Random& random, double low, double high) {
  const double length = power_of_ten(random, low, high);
  return length * random.direction();
}

std::uint32_t choose(Random& random, std::uint32_t count) {
  return static_cast<std::uint32_t>(random.between(0.0, count));
}

Shape box(Point3 a, Point3 b, bool inwards) {
  const std::array<std::array<Point3, 4>, 6> faces{{
      {{{a.x, a.y, b.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}}},
      {{{b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}}},
      {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}}},
      {{{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}},
      {{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}},
      {{{b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}}},
  }};
  Shape shape;
  for (const auto& face : faces)
    shape.add_fan(inwards ? std::vector<Point3>(face.begin(), face.end())
                          : std::vector<Point3>(face.rbegin(), face.rend()));
  return shape;
}

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Two triangles whose quad has a nearly vanishing side, angle or area, or is a dart.
Shape near_quad(Random& random) {
  const double tiny = power_of_ten(random, -8.0, -0.5);
  const std::array<std::vector<Point3>, 6> quads{{
      {{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {tiny, 2.25 * tiny, 0}},           // a side of nothing
      {{0, 0, 0}, {1, 0, 0}, {1, tiny, 0}, {0, 2.0 * tiny, 0}},                // a strip
      {{0, 0, 0}, {1, 0, 0}, {1.0 + tiny, 1, 0}, {1, 1.0 + tiny, 0}},          // a small corner
      {{0, 0, 0}, {1, 0, 0}, {0.5 - tiny, 0.5 - tiny, 0}, {0, 1, 0}},          // nearly a triangle
      {{0, 0, 0}, {1, 0, 0}, {tiny, tiny, 0}, {0, 1, 0}},                      // a dart
      {{0, 0, 0}, {1, 0, 0}, {1, 1, tiny}, {0, 1, -tiny * random.between(0, 1)}}}}; // bent
  Shape shape;
  shape.add_fan(quads[choose(random, quads.size())]);
  return shape;
}

/// A round plate, whole or a ring, about a corner of its rim or its middle.
Shape disc(Random& random) {
  const auto count = 3 + choose(random, happens(random, 0.1) ? 200 : 40);
  std::vector<Point3> rim;
  for (std::uint32_t k = 0; k < count; ++k)
    rim.push_back({0.5 * std::cos(turn * k / count), 0.5 * std::sin(turn * k / count), 0.0});
  Shape shape;
  if (happens(random, 0.5)) {
    shape.add_fan(rim);
    return shape;
  }
  rim.push_back(rim.front());
  rim.insert(rim.begin(), Point3(0.0));
  shape.add_fan(rim);
  return shape;
}

/// A polygon of long and short corners, whose fan is folded over itself.
Shape star(Random& random) {
  const auto count = 2 * (3 + choose(random, 12));
  const double inner = power_of_ten(random, -4.0, 0.0);
  std::vector<Point3> rim;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double radius = k % 2 == 0 ? 0.5 : 0.5 * inner;
    rim.push_back({radius * std::cos(turn * k / count), radius * std::sin(turn * k / count), 0.0});
  }
  Shape shape;
  shape.add_fan(rim);
  return shape;
}

/// Long thin triangles from one point.
Shape spikes(Random& random) {
  Shape shape;
  const double width = power_of_ten(random, -7.0, -1.0);
  for (std::uint32_t k = 0, count = 1 + choose(random, 12); k < count; ++k) {
    const Direction to = random.direction();
    shape.add_fan({Point3(0.0), to, to + width * random.direction()});
  }
  return shape;
}

/// The same sheet again, nearly or quite in its place, towards either side.
Shape sheets(Random& random) {
  Shape shape;
  const double apart = happens(random, 0.4) ? 0.0 : power_of_ten(random, -9.0, -1.0);
  for (std::uint32_t k = 0, count = 2 + choose(random, 3); k < count; ++k) {
    std::vector<Point3> sheet{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (Point3& point : sheet)
      point += Vec3(happens(random, 0.3) ? 0.25 * k : 0.0, 0.0, apart * k);
    if (happens(random, 0.5))
      std::swap(sheet[1], sheet[3]);
    shape.add_fan(sheet);
  }
  return shape;
}

/// Sheets through one another.
Shape crossing(Random& random) {
  Shape shape;
  for (std::uint32_t k = 0, count = 2 + choose(random, 4); k < count; ++k) {
    const Vec3 u = 0.5 * random.direction(), v = 0.5 * random.direction();
    const Point3 at = happens(random, 0.5) ? Point3(0.0) : 0.2 * random.direction();
    shape.add_fan({at - u - v, at + u - v, at + u + v, at - u + v});
  }
  return shape;
}

/// Rings of quads from pole to pole, where triangles have no area.
Shape ball(Random& random) {
  const auto rows = 2 + choose(random, 8), columns = 3 + choose(random, 10);
  Shape shape;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double up = 0.5 * turn * j / rows, round = turn * i / columns;
      shape.points.push_back({0.5 * std::sin(up) * std::cos(round), 0.5 * std::cos(up),
                              -0.5 * std::sin(up) * std::sin(round)});
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const auto at = j * (columns + 1) + i, below = at + columns + 1;
      shape.add_triangle(at, below, below + 1);
      shape.add_triangle(at, below + 1, at + 1);
    }
  return shape;
}

/// A grid whose points are off its plane by what quantising leaves, or by more.
Shape rough_grid(Random& random) {
  const auto count = 1 + choose(random, 8);
  const double height = power_of_ten(random, -9.0, -0.5);
  Shape shape;
  for (std::uint32_t j = 0; j <= count; ++j)
    for (std::uint32_t i = 0; i <= count; ++i)
      shape.points.push_back({double(i) / count, double(j) / count, height * random.between(-1, 1)});
  for (std::uint32_t j = 0; j < count; ++j)
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto at = j * (count + 1) + i, above = at + count + 1;
      shape.add_triangle(at, at + 1, above + 1);
      shape.add_triangle(at, above + 1, above);
    }
  return shape;
}

/// Triangles anywhere, some of them with hardly an area or with none.
Shape soup(Random& random) {
  Shape shape;
  for (std::uint32_t k = 0, count = 1 + choose(random, 30); k < count; ++k) {
    const Point3 a = random.in_box(Vec3(-0.5), Vec3(0.5));
    const Point3 b = a + offset_of_any_size(random, -6.0, 0.0);
    Point3 c = a + offset_of_any_size(random, -6.0, 0.0);
    if (happens(random, 0.1))
      c = happens(random, 0.5) ? a : glm::mix(a, b, random.between(-1.0, 2.0));
    shape.add_fan({a, b, c});
  }
  return shape;
}

/// Small things by the hundred: each a part of its own.
Shape crumbs(Random& random) {
  Shape shape;
  const auto count = happens(random, 0.2) ? 1500U : 100U;
  const double size = power_of_ten(random, -3.0, -1.0);
  const bool boxes = happens(random, 0.2);
  for (std::uint32_t k = 0; k < (boxes ? count / 12 : count); ++k) {
    const Point3 at = random.in_box(Vec3(-0.5), Vec3(0.5));
    if (boxes)
      shape.add(box(at, at + Vec3(size), false));
    else
      shape.add_fan({at, at + size * random.direction(), at + size * random.direction()});
  }
  return shape;
}

/// A strip that is divided on one side and not on the other.
Shape t_junctions(Random& random) {
  Shape shape;
  const auto count = 2 + choose(random, 9);
  shape.add_fan({{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0, 0.5, 0}});
  const double off = happens(random, 0.5) ? 0.0 : power_of_ten(random, -9.0, -3.0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double x0 = double(k) / count, x1 = double(k + 1) / count;
    shape.add_fan({{x0, 0.5 + off, 0}, {x1, 0.5 + off, 0}, {x1, 1, 0}, {x0, 1, 0}});
  }
  return shape;
}

/// Boxes that share faces, stand on one another or hold one another.
Shape stack(Random& random) {
  Shape shape;
  Point3 low(0.0);
  for (std::uint32_t k = 0, count = 1 + choose(random, 4); k < count; ++k) {
    const Vec3 size = random.in_box(Vec3(0.05), Vec3(0.6));
    shape.add(box(low, low + size, happens(random, 0.1)));
    const double gap = happens(random, 0.5) ? 0.0 : power_of_ten(random, -8.0, -2.0);
    low[static_cast<int>(choose(random, 3))] += gap + (happens(random, 0.8) ? size.y : 0.0);
  }
  return shape;
}

} // namespace

Shape hostile_shape(Random& random) {
  constexpr std::array kinds{near_quad,  near_quad, disc, star,   spikes,      sheets,   crossing,
                             ball,       rough_grid, soup, crumbs, t_junctions, stack};
  return kinds[choose(random, kinds.size())](random);
}

} // namespace meninas::test
