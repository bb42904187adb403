#include "reference/light_points.h"

#include "scenes/area_light.h"
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

/// p_l of the direction from x to a point of an area light.
static double choosing_density(const TracedScene& traced, const Point3& x, std::uint32_t area_light,
                        const Point3& point) {
  const Vec3 leg = point - x;
  const double distance2 = glm::dot(leg, leg);
  const double cosine =
      -glm::dot(traced.scene.area_lights[area_light].axis, leg) / std::sqrt(distance2);
  const double area_density = traced.lights.area_light_density[area_light];
  return cosine > 0.0 ? area_density * distance2 / cosine : 0.0;
}

std::vector<PassedLight> area_lights_passed(const TracedScene& traced, const Ray& ray,
                                            double distance, const Point3& x) {
  std::vector<PassedLight> passed;
  for (std::uint32_t k = 0; k < traced.scene.area_lights.size(); ++k) {
    const AreaLight& light = traced.scene.area_lights[k];
    const auto t = lit_crossing(light, ray.origin, ray.direction);
    if (t && *t < distance)
      passed.push_back({light.radiance,
                        choosing_density(traced, x, k, ray.origin + *t * ray.direction)});
  }
  return passed;
}

/// Evenly over the polygon.
static Point3 point_on(const AreaLight& light, double u, double v, double w) {
  const auto& p = light.corners;
  double before = 0.0;
  const double along = u * area_of(light);
  std::size_t k = 2;
  for (; k + 1 < p.size(); ++k) {
    const double own = 0.5 * glm::length(glm::cross(p[k - 1] - p[0], p[k] - p[0]));
    if (along < before + own)
      break;
    before += own;
  }
  const Vec2 place = even_barycentric(v, w);
  return p[0] + place.x * (p[k - 1] - p[0]) + place.y * (p[k] - p[0]);
}

/// A number of its own in [0, 1), for want of a fifth: where u lies in the light's share of all.
static double within(const LightTable& table, const Light& light, double u) {
  const auto k = static_cast<std::size_t>(&light - table.lights.data());
  const double below = k > 0 ? table.cumulative[k - 1] : 0.0;
  return std::clamp((u * table.cumulative.back() - below) / light.power, 0.0, 1.0);
}

double chain_chance(const TracedScene& traced, std::size_t length) {
  return std::pow(double(traced.mirror_planes.size()), -double(length));
}

LightPoint choose_point(const TracedScene& traced, const Point3& view,
                        const std::array<float, 4>& u) {
  const Light& light = choose_light(traced.lights, u[0]);
  if (light.triangle == none<TriangleId>) {
    const AreaLight& area_light = traced.scene.area_lights[light.area_light];
    const Point3 at = point_on(area_light, within(traced.lights, light, u[0]), u[1], u[2]);
    return {at, none<PlaneId>, area_light.radiance,
            choosing_density(traced, view, light.area_light, at)};
  }
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
