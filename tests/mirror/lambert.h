// Lambert's formula, written down once more so that the tests of mirrors stand on their own.
#pragma once

#include "mirror/convex_polygon.h"

#include <cmath>
#include <numbers>

namespace meninas::test {

inline double form_factor(const Point3& x, const Direction& normal, const ConvexPolygon& polygon) {
  double sum = 0.0;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Vec3 a = polygon.vertices[k] - x, b = polygon.vertices[(k + 1) % polygon.size] - x;
    const Vec3 c = glm::cross(a, b);
    const double sine = glm::length(c);
    if (sine > 0.0)
      sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, c) / sine;
  }
  return std::abs(sum) / (2.0 * std::numbers::pi);
}

} // namespace meninas::test
