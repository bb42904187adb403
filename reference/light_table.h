// The lights of a scene that have an extent, for next-event estimation:
// emitting triangles and area lights, chosen by their power.
//
// A point on an emitting triangle is chosen evenly over its area.
// As a density of directions at x that is
//   p(omega) = P(triangle) / area * distance^2 / |cos at the light|,
// the same number whether the light was chosen or met by chance:
// both are needed for multiple importance sampling.
#pragma once

#include "scenes/rays/ray_scene.h"
#include "scenes/materials/texture_lookup.h"

#include <array>
#include <vector>

namespace meninas::reference {

struct Light {
  TriangleId triangle = none<TriangleId>; ///< none: it is an area light
  std::uint32_t area_light = 0; ///< its number among them
  double power = 0.0; ///< as a share of all: the chance to be chosen
};

struct LightTable {
  std::vector<Light> lights;
  std::vector<double> cumulative;   ///< chances up to and with each light; the last is 1
  std::vector<double> area_density; ///< by triangle: P(triangle) / area, 0 where it does not emit
  std::vector<double> area_light_density; ///< by area light: P / area
};

/// The power of a textured triangle is that of the texture's mean.
LightTable make_light_table(const Scene& scene, const DecodedTextures& textures);

/// The light a number in [0, 1) stands for; precondition: there is one.
const Light& choose_light(const LightTable& table, double u);

/// Evenly over the triangle: weights of its second and third corner from two numbers in [0, 1).
Vec2 even_barycentric(double u, double v);

} // namespace meninas::reference
