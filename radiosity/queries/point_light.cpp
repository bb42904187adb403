#include "radiosity/queries/point_light.h"

#include "scenes/rays/ray_scene.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace meninas {

/// The plane that a point lies on, or none: what a ray from a little above it, straight down, meets
/// within twice that height.
static PlaneId plane_under(const LightScene& light, const QueryPoint& point) {
  constexpr double of_the_scene = 4e-6, parallel = 1e-3;
  const double size = 1.0 / light.rays.frame().scale;
  const double height = std::max(of_the_scene * size, 2.0 * light.surfaces.tolerance);
  const auto hit = closest_hit(light.rays, {.origin = point.position + height * point.normal,
                                            .direction = -point.normal,
                                            .max_distance = 2.0 * height});
  if (!hit)
    return none<PlaneId>;
  const PlaneId plane = light.surfaces.plane_of_triangle[index(hit->triangle)];
  const Direction& normal = light.surfaces.planes[index(plane)].normal;
  return glm::length(glm::cross(normal, point.normal)) < parallel ? plane : none<PlaneId>;
}

std::vector<PointIrradiance> irradiance_at_points(const LightScene& light,
                                                  SentLight reflected,
                                                  std::span<const QueryPoint> points,
                                                  const PointQuerySettings& settings,
                                                  const Progress& progress) {
  FormFactorSettings rays = settings.form_factors;
  rays.method = FormFactorMethod::rays;
  const PointGathering gathering(light, std::move(reflected), rays, settings.direct,
                                 {.rays = settings.rays, .cluster_shadow_rays = 32});
  std::vector<PointIrradiance> result(points.size());
  tbb::enumerable_thread_specific<PointWorkspace> spaces;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    const Receiver receiver{points[k].position, points[k].normal, plane_under(light, points[k])};
    const auto seed = hash(settings.direct.seed, 0x90147, static_cast<std::uint32_t>(k));
    const PointLight arrived = light_at(gathering, receiver, seed, spaces.local());
    const ArrivingLight all = arrived.all();
    const Rgb direct = arrived.direct.total + arrived.emission.total + arrived.sky.total;
    const GatheredRays& met = spaces.local().gather.result;
    const bool inside =
        all.total == Rgb(0.0) && met.landed == 0.0 && met.escaped == 0.0 && met.cut == 0.0;
    std::vector<Rgb> by_lamp = spaces.local().direct_by_lamp;
    for (std::size_t l = 0; l < spaces.local().indirect_by_lamp.size(); ++l)
      by_lamp[l] += spaces.local().indirect_by_lamp[l];
    result[k] = {all.total, direct, all.mirrored, std::move(by_lamp), inside};
    if (progress)
      progress("points", double(++done) / double(points.size()));
  });
  return result;
}

} // namespace meninas
