// Reflection and refraction of a ray at the face of a solid of glass, in pass one.
//
//   R = F(cos), T = (1 - F) t,   sin = n sin' (Snell), all is reflected beyond sin' = 1,   a^(metres / distance) on the way inside
//
// with F of one face (scenes/materials/glass.h), t its base colour, and a the colour of attenuation:
// scenes/materials/refraction.h. Nothing is said of light inside but where it comes out.
// A ray goes one of the two ways, by the chance that panes have (hemisphere_rays.h).
//
// Limits: the roughness of solids is ignored.
// Where solids touch or lie in one another a face counts as one between its solid and air.
// Chains of more than `max_meetings` meetings are cut:
// light that total reflection would keep inside for ever.
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

inline constexpr std::uint32_t max_meetings = 256;

// Rays whose first meeting is with a solid are in no mirror world from there on,
// but it is known who owns the emission that they find:
// what emitters send by way of solids first is found by glass_light.h,
// and by rays that meet a mirror or a pane before a solid where they are gathered (`none`).
inline constexpr WorldId through_solids{0xfffffffeU}; ///< refracted alone
inline constexpr WorldId off_solids{0xfffffffdU};     ///< reflected on the way as well, by whatever
constexpr bool is_by_solids(WorldId world) {
  return world == through_solids || world == off_solids;
}

/// The world of a ray that goes on from the face of a solid;
/// `first`: it has met neither mirrors nor glass before.
constexpr WorldId world_from_solid(WorldId before, bool first, bool reflected) {
  if (!first && !is_by_solids(before))
    return none<WorldId>;
  return reflected || before == off_solids ? off_solids : through_solids;
}

/// The face of a solid as a ray meets it, from outside or, at its back, from inside.
Bsdf solid_face(const LightScene& light, TriangleId triangle, Vec2 barycentric, bool front);

/// Where a ray of this direction comes from behind the face, whose normal is towards the ray.
/// None beyond total reflection.
std::optional<Direction> refracted(const LightScene& light, TriangleId triangle, bool front,
                                   const Direction& normal, const Vec3& direction);

/// The solid behind a face.
MaterialId medium_behind(const LightScene& light, TriangleId triangle, bool front);

/// The transmittance, by channel, of a leg that ends on a triangle, or none:
/// `before` is the solid that the ray was refracted into.
glm::vec3 left_by_solid(const LightScene& light, TriangleId met, bool front, MaterialId before,
                        double metres);

} // namespace meninas
