#include "radiosity/element_light.h"

#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

/// The mean over the exposed part of an area. `element` is the one it is, if it is one.
ArrivingLight mean_over(const LightScene& light, const ReceiverArea& area, CoveredCells covered,
                        ElementId element, std::uint32_t seed, const DirectSettings& settings,
                        SharedLightWorkspace& work) {
  std::uint32_t next = 0;
  const auto next_point = [&]() -> NumberedPoint {
    const NumberedPlace place = exposed_place(light, area, covered, seed, next);
    next = place.number + 1;
    return {{point_in(area, place.st), area.normal, area.plane_class, Vec3(0.0), area.coat},
            place.number,
            element};
  };
  return shared_irradiance(light, next_point,
                           {.points = settings.points,
                            .most_points = settings.most_points,
                            .images = settings.images_in_element,
                            .rays = settings.rays_in_element,
                            .solid_rays = settings.solid_rays_in_element},
                           seed, work);
}

} // namespace

ArrivingLight direct_irradiance(const LightScene& light, ElementId element, CoveredCells covered,
                                const DirectSettings& settings, SharedLightWorkspace& work) {
  if (covered == wholly_covered)
    return {};
  return mean_over(light, receiver_of(light, element), covered, element,
                   hash(index(element), settings.seed, 0xd17ec7), settings, work);
}

MeansOfAreas
means_of_areas(std::size_t count,
               const std::function<ArrivingLight(std::size_t, SharedLightWorkspace&)>& mean,
               const Progress& progress) {
  constexpr std::size_t chunk_size = 64;
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  MeansOfAreas means;
  means.light.resize(count);
  tbb::enumerable_thread_specific<SharedLightWorkspace> workspaces;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    SharedLightWorkspace& work = workspaces.local();
    for (std::size_t k = c * chunk_size; k < std::min(count, (c + 1) * chunk_size); ++k)
      means.light[k] = mean(k, work);
    if (progress)
      progress("direct light", static_cast<double>(++done) / static_cast<double>(chunks));
  });
  for (const auto& work : workspaces)
    means.shadow_rays += work.point.shadow_rays;
  return means;
}

DirectIrradiance direct_irradiance(const LightScene& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  DirectIrradiance result;
  result.irradiance.assign(size, Rgb(0.0));
  if (light.emitters.empty() && light.punctual.empty())
    return result;
  result.punctual.resize(light.punctual.empty() ? 0 : size);
  const MeansOfAreas means = means_of_areas(
      size,
      [&](std::size_t i, SharedLightWorkspace& work) {
        return direct_irradiance(light, static_cast<ElementId>(i), covered.empty() ? 0 : covered[i],
                                 settings, work);
      },
      progress);
  for (std::size_t i = 0; i < size; ++i) {
    result.irradiance[i] = means.light[i].total;
    if (!result.punctual.empty())
      result.punctual[i] = means.light[i].punctual;
  }
  result.shadow_rays = means.shadow_rays;
  return result;
}

} // namespace meninas
