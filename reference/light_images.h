// Punctual lights and their images in plane mirrors, for next-event estimation.
//
// Light without extent cannot be met, so all of it is looked for, from every vertex.
// The chain m1 ... mL of a path x -> z1 -> ...
// -> zL -> y is unfolded at the other end than in mirrored_lights.h: x sees the light R_m1 ...
// R_mL y straight, through the mirrors' extents one after the other.
//
// The power of a light does not say whether it reaches x: the sun shines on the whole scene and
// may enter by a slit. A light chosen with probability c counts E / c where it reaches x, with
// variance E^2 (1 / c - 1), so no probability that is the same everywhere is good.
// So every image that can reach x is tested. Tests without rays exclude the others:
// cones, horizons, a mirror's extent missed by the straight line. If there are more than `max_images`
// images, that many are chosen evenly; if more than `max_connections` remain, that many are chosen
// by what they would bring (systematic sampling, Madow 1949), which is unbiased.
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
