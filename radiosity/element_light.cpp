#include "radiosity/element_light.h"

#include "radiosity/facets.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace meninas {

ArrivingLight direct_irradiance(const LightScene& light, ElementId element, CoveredCells covered,
                                const DirectSettings& settings, SharedLightWorkspace& work) {
  constexpr int whole = 64;
  if (std::popcount(covered) == whole)
    return {};
  const ReceiverArea area = receiver_of(light, element);
  const auto seed = hash(index(element), settings.seed, 0xd17ec7);
  std::uint32_t next = 0;
  const auto next_point = [&]() -> NumberedPoint {
    for (;;) {
      const std::uint32_t number = next++;
      const Vec2 sample(sobol2(number, seed, SobolPair::first));
      if (is_covered(covered, sample.x, sample.y))
        continue;
      return {{point_in(area, sample), area.normal, area.plane_class, Vec3(0.0), area.coat},
              number,
              element};
    }
  };
  return shared_irradiance(light, next_point,
                           {.points = settings.points,
                            .most_points = settings.most_points,
                            .images = settings.images_in_element,
                            .rays = settings.rays_in_element,
                            .solid_rays = settings.solid_rays_in_element},
                           seed, work);
}

DirectSettings shared_out(DirectSettings settings, std::size_t elements) {
  const double share = double(settings.points_in_all) / double(std::max<std::size_t>(elements, 1));
  if (settings.points_in_all == 0 || share >= settings.points)
    return settings;
  const auto points = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(share))));
  // Doubling where the first points disagree darkens the outer half of a penumbra, the more the fewer they are.
  const double fewer = double(points) / settings.points;
  settings.most_points = std::max(points, static_cast<int>(settings.most_points * fewer * fewer));
  settings.points = points;
  return settings;
}

DirectIrradiance direct_irradiance(const LightScene& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& all, const Progress& progress) {
  constexpr std::size_t chunk_size = 64;
  const std::size_t size = element_count(light.mesh);
  const DirectSettings shared = shared_out(all, size);
  DirectIrradiance result;
  result.irradiance.assign(size, Rgb(0.0));
  if (light.emitters.empty() && light.punctual.empty())
    return result;
  result.punctual.resize(light.punctual.empty() ? 0 : size);

  const std::size_t chunks = (size + chunk_size - 1) / chunk_size;
  // What facets receive is seen of them.
  std::vector<std::uint8_t> seen(size, 0);
  if (shared.points < all.points)
    if (const VertexElements facets = facets_around(light); !facets.elements.empty())
      seen = averaged_facets(light.mesh, facets);
  tbb::enumerable_thread_specific<SharedLightWorkspace> workspaces;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    SharedLightWorkspace& work = workspaces.local();
    const std::size_t end = std::min(size, (c + 1) * chunk_size);
    for (std::size_t i = c * chunk_size; i < end; ++i) {
      const ArrivingLight mean =
          direct_irradiance(light, static_cast<ElementId>(i), covered.empty() ? 0 : covered[i],
                            seen[i] != 0 ? all : shared, work);
      result.irradiance[i] = mean.total;
      if (!result.punctual.empty())
        result.punctual[i] = mean.punctual;
    }
    if (progress)
      progress("direct light", static_cast<double>(++done) / static_cast<double>(chunks));
  });
  for (const auto& work : workspaces)
    result.shadow_rays += work.point.shadow_rays;
  return result;
}

} // namespace meninas
