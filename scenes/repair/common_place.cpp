#include "scenes/repair/common_place.h"

#include "scenes/surfaces/principal_axes.h"

#include <cmath>

namespace meninas {

Vec3 way_into(const Point3& x, std::span<const Plane> planes) {
  constexpr double same_plane = 0.05;
  glm::dmat3 squares(0.0);
  Vec3 moments(0.0);
  for (const Plane& plane : planes) {
    squares += glm::outerProduct(plane.normal, plane.normal);
    moments -= signed_distance(plane, x) * plane.normal;
  }
  // The values of N^T N are the squares of N's singular values. Along axes where that is small, planes say nothing.
  const auto [values, axes] = principal_axes(squares);
  Vec3 way(0.0);
  for (std::size_t k = 0; k < 3; ++k)
    if (values[k] > same_plane * same_plane * values[2])
      way += glm::dot(axes[k], moments) / values[k] * axes[k];
  // Coordinates whose squares overflow have no place in common.
  return std::isfinite(glm::dot(way, way)) ? way : Vec3(0.0);
}

} // namespace meninas
