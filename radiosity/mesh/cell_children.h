// The child of a cell that holds a point: cells are divided into four by the middles of their edges.
//
// A quad's children are (0,0), (1,0), (0,1), (1,1) of a 2 x 2 grid. A triangle's first three keep
// its corner of that number and point as it does; the fourth, in the middle, is turned half round:
// its corners are the middles of the edges that do not, in turn, touch corner 0, 1, 2.
#pragma once

#include <cstdint>

namespace meninas {

template <typename Point>
struct ChildPoint {
  std::uint32_t child; ///< 0 to 3
  Point st;            ///< in the child's own coordinates
};

/// The nearest number in [0, 1], and 0 for what is no number: a cell is an index made of it.
template <typename Real>
Real within_unit(Real x) {
  return x > Real(0) ? x < Real(1) ? x : Real(1) : Real(0);
}

/// `st` in [0, 1]^2, of a triangle s + t <= 1.
template <typename Point>
ChildPoint<Point> child_at(Point st, bool triangle) {
  using Real = typename Point::value_type;
  constexpr Real half = Real(0.5);
  const bool right = st.x >= half, up = st.y >= half;
  if (triangle && !right && !up && st.x + st.y > half)
    return {3, Point(Real(1) - Real(2) * st.x, Real(1) - Real(2) * st.y)};
  const Point corner(right ? Real(1) : Real(0), up ? Real(1) : Real(0));
  return {(right ? 1U : 0U) + (up ? 2U : 0U), Real(2) * st - corner};
}

} // namespace meninas
