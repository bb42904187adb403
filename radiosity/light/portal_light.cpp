#include "radiosity/light/portal_light.h"

#include "scenes/sky/radiance_map.h"

#include <numbers>

namespace meninas {

Leg shadow_leg(const LightScene& light, const Emitter& emitter, Leg to_emitter) {
  if (!emitter.shows_sky())
    return to_emitter;
  constexpr double beyond = 8.0; // in the frame the scene is 2 wide
  const Vec3 along = to_emitter.to - to_emitter.from;
  const double length = glm::length(along);
  if (length > 0.0)
    to_emitter.to += beyond / (light.rays.frame().scale * length) * along;
  to_emitter.arriving = none<PlaneId>;
  return to_emitter;
}

Rgb shown_by(const LightScene& light, const Emitter& emitter, const FoldedSegment& segment) {
  if (!is_uneven(light, emitter) || segment.legs.empty())
    return Rgb(1.0);
  const Leg& last = segment.legs.back();
  const Vec3 direction = last.to - last.from;
  if (light.portals.size() > 1 &&
      last_portal(light.portals, last.from, direction,
                  min_height(light.surfaces.tolerance, segment.legs.size() > 1)) !=
          emitter.portal)
    return Rgb(0.0);
  if (light.sky == nullptr)
    return Rgb(1.0);
  return std::numbers::pi * Rgb(radiance_from(*light.sky, direction, Suns::left_out)) /
         emitter.radiosity;
}

} // namespace meninas
