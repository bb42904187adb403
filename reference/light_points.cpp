#include "reference/light_points.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

VertexNumbers vertex_numbers(std::uint32_t path, std::uint32_t bounce, std::uint32_t seed) {
  VertexNumbers numbers;
  numbers.scatter = sobol4(path, hash(seed, bounce, 1));
  for (std::uint32_t length = 0; length <= longest_chain; ++length)
    numbers.light[length] = sobol4(path, hash(seed, bounce, 2 + length));
  return numbers;
}

SkyNumbers sky_numbers(std::uint32_t path, std::uint32_t bounce, std::uint32_t seed) {
  SkyNumbers numbers;
  for (std::uint32_t length = 0; length <= longest_chain; ++length)
    numbers[length] = sobol4(path, hash(seed, bounce, 3 + longest_chain + length));
  return numbers;
}

double choosing_density(const TracedScene& traced, const Point3& x, const SurfacePoint& light) {
  const Vec3 leg = light.position - x;
  const double distance2 = glm::dot(leg, leg);
  const double cosine = std::abs(glm::dot(light.face, leg)) / std::sqrt(distance2);
  const double area_density = traced.lights.area_density[index(light.triangle)];
  return cosine > 0.0 ? area_density * distance2 / cosine : 0.0;
}

double chain_chance(const TracedScene& traced, std::size_t length) {
  return std::pow(double(traced.mirror_planes.size()), -double(length));
}

LightPoint choose_point(const TracedScene& traced, const Point3& view,
                        const std::array<float, 4>& u) {
  const Light& light = choose_light(traced.lights, u[0]);
  const Vec2 place = even_barycentric(u[1], u[2]);
  SurfacePoint at = surface_point(traced, light.triangle, place, true);
  if (glm::dot(view - at.position, at.face) < 0.0)
    at = surface_point(traced, light.triangle, place, false);
  return {at.position, at.plane, at.hole ? Rgb(0.0) : at.material.emission,
          choosing_density(traced, view, at)};
}

LightPoint choose_sky(const TracedScene& traced, const Point3& view,
                      const std::array<float, 4>& u) {
  constexpr double beyond = 8.0; // in the frame the scene is 2 wide
  const Environment& sky = traced.scene.background;
  const SkySample drawn = sample_sky(sky, traced.sky, u);
  return {view + beyond / traced.rays.frame().scale * drawn.direction, none<PlaneId>,
          radiance_from(sky, drawn.direction), drawn.density};
}

} // namespace meninas::reference
