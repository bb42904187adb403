#include "form_factors/point_form_factor.h"

#include <cmath>
#include <numbers>

namespace meninas {

double point_form_factor(const Point3& x, const Direction& normal,
                         std::span<const Point3> polygon) {
  double sum = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point3& next = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const Vec3 a = polygon[k] - x;
    const Vec3 b = next - x;

    // a x b = a x (b - a):
    // the edge itself is known without the cancellation that b - a would bring for a far polygon.
    const Vec3 cross = glm::cross(a, next - polygon[k]);
    const double sine = glm::length(cross);
    if (sine == 0.0)
      continue;
    const double angle = std::atan2(sine, glm::dot(a, b));
    sum += angle / sine * glm::dot(normal, cross);
  }
  return std::abs(sum) / (2.0 * std::numbers::pi);
}

} // namespace meninas
