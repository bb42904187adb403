// Points in a balanced tree of halves (Bentley 1975), for look-ups by boxes of any shape:
// the grid of neighbour_grid.h is for small ones.
#pragma once

#include "scenes/camera.h"
#include "scenes/types.h"

#include <algorithm>
#include <span>
#include <vector>

namespace meninas {

class PointTree {
public:
  explicit PointTree(std::vector<Point3> points) : points_(std::move(points)), order_(points_.size()) {
    for (std::uint32_t k = 0; k < order_.size(); ++k) {
      order_[k] = k;
    }
    divide(order_, 0);
  }

  /// Calls visit(k) for the points in the box until it returns false.
  template <typename Visit>
  void visit_inside(const Bounds& box, Visit&& visit) const {
    walk(order_, 0, box, visit);
  }

private:
  /// The middle one of a run is the node that divides it, along x, y and z in turn.
  void divide(std::span<std::uint32_t> run, int axis) {
    if (run.size() < 2) {
      return;
    }
    const auto middle = run.begin() + static_cast<std::ptrdiff_t>(run.size() / 2);
    std::ranges::nth_element(run, middle, {}, [&](std::uint32_t k) { return points_[k][axis]; });
    divide(run.first(run.size() / 2), (axis + 1) % 3);
    divide(run.subspan(run.size() / 2 + 1), (axis + 1) % 3);
  }

  template <typename Visit>
  bool walk(std::span<const std::uint32_t> run, int axis, const Bounds& box, Visit& visit) const {
    if (run.empty()) {
      return true;
    }
    const std::uint32_t k = run[run.size() / 2];
    const Point3& p = points_[k];
    if (p[axis] >= box.low[axis] &&
        !walk(run.first(run.size() / 2), (axis + 1) % 3, box, visit)) {
      return false;
    }
    const bool inside = glm::all(glm::lessThanEqual(box.low, p)) &&
                        glm::all(glm::lessThanEqual(p, box.high));
    if (inside && !visit(k)) {
      return false;
    }
    return p[axis] > box.high[axis] || walk(run.subspan(run.size() / 2 + 1), (axis + 1) % 3, box, visit);
  }

  std::vector<Point3> points_;
  std::vector<std::uint32_t> order_;
};

} // namespace meninas
