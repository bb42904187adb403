// Punctual lights and their images in plane mirrors, for next-event estimation.
//
// Light without extent cannot be met, so all of it is looked for, from every vertex.
// The chain m1 ... mL of a path x -> z1 -> ...
// -> zL -> y is unfolded at the other end than in mirrored_lights.h: x sees the light R_m1 ...
// R_mL y straight, through the mirrors' extents one after the other.
//
// Which light reaches x is not told by its power: the sun, which shines on the whole scene,
// may enter by a slit. If one light is chosen by a chance c it brings E / c where it does reach,
// of variance E^2 (1 / c - 1): no chance that is the same everywhere is good.
// So every image that can reach x is asked for; what tells the others costs no ray:
// cones, horizons, a mirror's extent missed by the straight line. Of more than `max_images`
// images so many are chosen evenly, of more than `max_connections` that remain so many
// by what they would bring (systematic sampling, Madow 1949): the expectation is that of all.
#pragma once

#include "reference/traced_scene.h"

namespace meninas::reference {

inline constexpr std::size_t max_images = 1024;
inline constexpr std::size_t max_connections = 8;

/// The images of all lights over chains of at most `longest_chain` of the planes.
std::vector<LightImage> make_light_images(const Scene& scene, const SurfaceModel& surfaces,
                                          const std::vector<Bsdf>& bsdfs,
                                          const std::vector<PlaneId>& mirror_planes);

/// An image to be asked for, and what it brings if nothing is between,
/// over the chance that it was chosen by.
struct ImageConnection {
  const LightImage* image = nullptr;
  Point3 target{0.0}; ///< where it is seen
  Rgb radiance{0.0};
};

/// Chooses images by the light that x scatters to `out` (from its normal); `u` is uniform in
/// [0, 1)^2. `chosen` is cleared first.
void choose_images(const TracedScene& traced, const SurfacePoint& x, const Direction& out, Vec2 u,
                   std::vector<ImageConnection>& chosen);

} // namespace meninas::reference
