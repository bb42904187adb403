#include "scenes/area_light.h"

namespace meninas {

/// Its length is the area, its direction that of the light's axis.
static Vec3 area_vector_of(const AreaLight& light) {
  Vec3 sum(0.0);
  const auto& p = light.corners;
  for (std::size_t k = 2; k < p.size(); ++k)
    sum += 0.5 * glm::cross(p[k - 1] - p[0], p[k] - p[0]);
  return sum;
}

double area_of(const AreaLight& light) { return glm::length(area_vector_of(light)); }

std::optional<double> lit_crossing(const AreaLight& light, const Point3& origin,
                                   const Vec3& direction) {
  const auto& p = light.corners;
  const double approach = glm::dot(light.axis, direction),
               height = glm::dot(light.axis, origin - p[0]);
  if (!(approach < 0.0) || !(height > 0.0))
    return std::nullopt;
  const double t = height / -approach;
  const Point3 at = origin + t * direction;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vec3 edge = p[(k + 1) % p.size()] - p[k];
    if (glm::dot(glm::cross(edge, at - p[k]), light.axis) < 0.0)
      return std::nullopt;
  }
  return t;
}

} // namespace meninas
