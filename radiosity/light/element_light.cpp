#include "radiosity/light/element_light.h"

#include "radiosity/light/virtual_light_visibility.h"
#include "radiosity/light/spot_parts.h"
#include "radiosity/scene/small_elements.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

namespace meninas {

namespace {

/// An element as it receives light.
struct Receiving {
  const Lighting& light;
  ElementId element;
  ReceiverArea area;
  ContactMask covered;
  std::uint32_t seed;
  const DirectSettings& settings;

  Receiver at(const Point3& x) const {
    return {x, area.normal, area.plane_class, Vec3(0.0), area.coat};
  }
};

/// The light of all lights.
ArrivingLight shared_mean(const Receiving& r, SharedLightWorkspace& work) {
  const SharedLightSettings settings{.points = r.settings.points,
                                     .max_points = r.settings.max_points,
                                     .images = r.settings.images_in_element,
                                     .rays = r.settings.rays_in_element,
                                     .solid_rays = r.settings.solid_rays_in_element,
                                     .caches_occluders = true};
  // Each time from the same points by other rays: those that have taught what blocks them have missed the rest.
  const auto found = [&](std::uint32_t time) {
    std::uint32_t next = 0;
    const std::uint32_t seed = time == 0 ? r.seed : hash(r.seed, time);
    const auto next_point = [&]() -> NumberedPoint {
      const NumberedPlace place = next_open_point(r.light.scene, r.area, r.covered, r.seed, next);
      next = place.number + 1;
      return {r.at(point_in(r.area, place.st)), place.number, r.element};
    };
    return mean_direct_irradiance(r.light, next_point, settings, seed, work);
  };
  constexpr std::uint32_t times_learned = 2;
  work.blockers_of.clear();
  ArrivingLight light = found(0);
  for (std::uint32_t time = 1; time <= times_learned && work.has_new_occluders; ++time)
    light = found(time);
  return light;
}

/// The irradiance at a point from the light of a spot, in its world.
Rgb arriving_from(const Lighting& light, const SpotPart& part, const Receiver& receiver,
                  DirectWorkspace& work) {
  constexpr double beyond = 8.0; // in the frame the scene is 2 wide
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  seen_worlds(light.worlds, observer, work.seen);
  punctual_images(light.worlds, std::span(light.punctual).subspan(part.light, 1), work.seen, observer,
                  beyond / light.scene.rays.frame().scale, work.images);
  Rgb sum(0.0);
  for (const PunctualImage& image : work.images) {
    if (image.world != part.world)
      continue;
    fold(light.scene, image.world,
         {receiver.position, image.position, receiver.plane_class, none<PlaneId>}, work.folded[0],
         Solids::sheets);
    // No ray meets what has no extent: solids let it pass straight.
    if (blocked(light.scene, work.folded, 1, work.shadow_rays) == 0)
      sum += light.worlds.worlds[index(image.world)].throughput * image.irradiance *
             transmittance_between(light.scene, end_of(receiver), {}, work.folded[0]);
  }
  return sum;
}

/// The area on which nothing stands.
double exposed_area(const Receiving& r) {
  constexpr std::uint32_t places = 32;
  const double whole = r.light.scene.mesh.area[index(r.element)];
  if (r.covered == 0)
    return whole;
  std::uint32_t next = 0;
  for (std::uint32_t k = 0; k < places; ++k)
    next = next_open_point(r.light.scene, r.area, r.covered, r.seed, next).number + 1;
  return whole * places / next;
}

/// The light of a spot over its part, W: where something stands its shadow rays end.
Rgb power_on(const Receiving& r, const SpotPart& part, DirectWorkspace& work) {
  constexpr int points = 256;
  const std::uint32_t seed = hash(r.seed, part.light, index(part.world));
  Rgb sum(0.0);
  for (int k = 0; k < points; ++k) {
    const Vec2 st(sobol2(static_cast<std::uint32_t>(k), seed, SobolPair::first));
    const SpotSample sample = sample_spot(part, st);
    sum += sample.area * arriving_from(r.light, part, r.at(sample.at), work);
  }
  return sum / static_cast<double>(points);
}

} // namespace

MeanLight direct_irradiance(const Lighting& light, ElementId element, ContactMask covered,
                            const DirectSettings& asked, SharedLightWorkspace& work) {
  if (covered == wholly_covered)
    return {};
  DirectSettings settings = asked;
  if (has_reduced_samples(light.scene, element)) {
    for (int* samples : {&settings.points, &settings.max_points, &settings.images_in_element})
      *samples = reduced_count(*samples);
    // A face of a lamp reflects little beside its emission: the mean of many faces has to settle, not each.
    if (light.scene.mesh.emission[index(element)] != Rgb(0.0))
      settings.max_points = settings.points;
  }
  const Receiving r{light,
                    element,
                    receiver_of(light.scene, element),
                    covered,
                    hash(index(element), settings.seed, 0xd17ec7),
                    settings};
  work.spots = spots_on(light.scene.mesh, light.worlds, light.punctual, element);
  std::erase_if(work.spots, [](const SpotPart& part) { return part.is_whole(); });
  const ArrivingLight shared = shared_mean(r, work);
  const std::vector<SpotPart> spots = std::exchange(work.spots, {});
  Rgb punctual(0.0);
  for (const SpotPart& part : spots) {
    const Rgb by_spot = power_on(r, part, work.point) / exposed_area(r);
    punctual += by_spot;
    if (light.lamps)
      work.point.by_lamp[light.lamps->of_punctual[part.light]] += by_spot;
  }
  return {shared.total + punctual, shared.entering + punctual};
}

MeansOfAreas
means_of_areas(std::size_t count, std::size_t lamps,
               const std::function<MeanLight(std::size_t, SharedLightWorkspace&)>& mean,
               const Progress& progress) {
  constexpr std::size_t chunk_size = 64;
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  MeansOfAreas means;
  means.light.resize(count);
  if (lamps > 0)
    means.by_lamp = no_light(count, lamps);
  tbb::enumerable_thread_specific<SharedLightWorkspace> workspaces;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    SharedLightWorkspace& work = workspaces.local();
    for (std::size_t k = c * chunk_size; k < std::min(count, (c + 1) * chunk_size); ++k) {
      work.point.by_lamp.clear();
      means.light[k] = mean(k, work);
      set_row(means.by_lamp, k, work.point.by_lamp);
    }
    if (progress)
      progress("direct light", static_cast<double>(++done) / static_cast<double>(chunks));
  });
  for (const auto& work : workspaces)
    means.shadow_rays += work.point.shadow_rays;
  return means;
}

DirectIrradiance direct_irradiance(const Lighting& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress) {
  const std::size_t size = element_count(light.scene.mesh);
  DirectIrradiance result;
  result.irradiance.assign(size, Rgb(0.0));
  if (light.lamps)
    result.by_lamp = no_light(size, light.lamps->count);
  if (light.emitters.empty() && light.punctual.empty())
    return result;
  result.entering.resize(sends_from_no_face(light) ? size : 0);
  MeansOfAreas means = means_of_areas(
      size, light.lamps ? light.lamps->count : 0,
      [&](std::size_t i, SharedLightWorkspace& work) {
        return direct_irradiance(light, static_cast<ElementId>(i), covered.empty() ? 0 : covered[i],
                                 settings, work);
      },
      progress);
  for (std::size_t i = 0; i < size; ++i) {
    result.irradiance[i] = means.light[i].total;
    if (!result.entering.empty())
      result.entering[i] = means.light[i].entering;
  }
  result.by_lamp = std::move(means.by_lamp);
  add_up_to(result.irradiance, result.by_lamp);
  result.shadow_rays = means.shadow_rays;
  return result;
}

} // namespace meninas
