// Points of lights chosen to be looked for, and the densities of their choice:
//
//   p_l(w) = P(triangle) / area * d^2 / |cos at the light|,   or p(w) of the sky (sky_table.h)      1/sr
//
// over a chain of L of M mirrors divided by M^L; and the numbers of a path's vertex that choose.
#pragma once

#include "reference/mirrored_lights.h"

#include <array>

namespace meninas::reference {

/// The random numbers of a vertex: four for each of its decisions.
struct VertexNumbers {
  std::array<std::array<float, 4>, longest_chain + 1> light;
  std::array<float, 4> scatter;
};
VertexNumbers vertex_numbers(std::uint32_t path, std::uint32_t bounce, std::uint32_t seed);

/// By the length of the chain over which the sky is looked for.
using SkyNumbers = std::array<std::array<float, 4>, longest_chain + 1>;
SkyNumbers sky_numbers(std::uint32_t path, std::uint32_t bounce, std::uint32_t seed);

/// A point of a light as it is seen from somewhere.
struct LightPoint {
  Point3 position;
  PlaneId plane = none<PlaneId>;
  Rgb light{0.0};       ///< radiance
  double density = 0.0; ///< p_l
};

/// A point of an emitting surface or an area light, as the view sees it.
LightPoint choose_point(const TracedScene& traced, const Point3& view,
                        const std::array<float, 4>& u);

/// A place in the sky, beyond everything.
LightPoint choose_sky(const TracedScene& traced, const Point3& view,
                      const std::array<float, 4>& u);

/// p_l of the direction from x to a point of a light.
double choosing_density(const TracedScene& traced, const Point3& x, const SurfacePoint& light);

/// An area light on the way of a ray: what it shines, and p_l of that direction from x.
struct PassedLight {
  Rgb radiance{0.0};
  double density = 0.0;
};
std::vector<PassedLight> area_lights_passed(const TracedScene& traced, const Ray& ray,
                                            double distance, const Point3& x);

/// p_l of a chain of that many mirrors, as a share of that of direct light.
double chain_chance(const TracedScene& traced, std::size_t length);

} // namespace meninas::reference
