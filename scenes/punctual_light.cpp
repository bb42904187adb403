#include "scenes/punctual_light.h"

#include "scenes/ies/intensity_distribution.h"

#include <algorithm>
#include <cmath>

namespace meninas {

/// KHR_lights_punctual: a smooth fall from the inner to the outer cone.
static double spot_falloff(const PunctualLight& light, double cosine) {
  const double inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
  const double t = std::clamp((cosine - outer) / std::max(1e-3, inner - outer), 0.0, 1.0);
  return t * t;
}

PunctualSample punctual_sample(const PunctualLight& light, const Point3& x, double reach) {
  if (light.kind == PunctualKind::directional)
    return {x - reach * light.direction, light.intensity};
  const Vec3 from_light = x - light.position;
  const double distance2 = glm::dot(from_light, from_light);
  if (distance2 == 0.0)
    return {light.position, Rgb(0.0)};
  const double cosine = glm::dot(from_light, light.direction) / std::sqrt(distance2);
  double falloff = light.kind == PunctualKind::spot ? spot_falloff(light, cosine) : 1.0;
  // A luminaire on a face is a spot of half of all directions (repair/touching.h).
  if (light.distribution)
    falloff *= intensity_at(*light.distribution,
                            glm::transpose(light.frame) * (from_light / std::sqrt(distance2)));
  const Rgb from_foot = 2.0 * std::max(0.0, cosine) * light.foot_reflectance;
  return {light.position, light.intensity * (falloff + from_foot) / distance2};
}

} // namespace meninas
