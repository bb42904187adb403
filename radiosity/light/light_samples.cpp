#include "radiosity/light/light_samples.h"

#include "radiosity/light/virtual_light_visibility.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

void punctual_arrivals(const Lighting& light, const Receiver& receiver, DirectWorkspace& work,
                       std::vector<PunctualArrival>& arrivals) {
  arrivals.clear();
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  constexpr double beyond = 8.0; // in the frame the scene is 2 wide
  seen_worlds(light.worlds, observer, work.seen);
  punctual_images(light.worlds, light.punctual, work.seen, observer,
                  beyond / light.scene.rays.frame().scale, work.images);
  for (std::size_t first = 0; first < work.images.size();) {
    // Images of one world have as many legs each.
    const WorldId world = work.images[first].world;
    std::uint32_t count = 0;
    while (count < 16 && first + count < work.images.size() &&
           work.images[first + count].world == world) {
      fold(light.scene, world,
           {receiver.position, work.images[first + count].position, receiver.plane_class,
            none<PlaneId>},
           work.folded[count], Solids::sheets);
      ++count;
    }
    // No ray meets what has no extent: solids let it pass straight.
    const std::uint32_t dark =
        blocked(light.scene, work.folded, count, work.shadow_rays);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (((dark >> k) & 1U) != 0)
        continue;
      const PunctualImage& image = work.images[first + k];
      arrivals.push_back(
          {glm::normalize(image.position - receiver.position),
           light.worlds.worlds[index(world)].throughput * image.irradiance *
               transmittance_between(light.scene, end_of(receiver), {}, work.folded[k]),
           world, image.light});
    }
    first += count;
  }
}

void emission_samples(const Lighting& light, const Receiver& receiver,
                      const EmissionSampling& sampling, DirectWorkspace& work,
                      std::vector<EmissionSample>& samples) {
  samples.clear();
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  const LightChoice choice{static_cast<std::size_t>(sampling.images),
                           0x1p-32 * hash(sampling.seed, 0xc401ce, sampling.first)};
  sample_light_tree({light.worlds, light.emitters, light.emitter_tree}, observer, choice,
                    work.choice, work.lights);
  const auto count = static_cast<std::uint32_t>(std::clamp(sampling.per_image, 1, 16));
  for (const VirtualLight& image : work.lights) {
    const Emitter& emitter = light.emitters[image.emitter];
    if (emitter.shows_sky())
      continue; // rays find it
    const Vec3 area = area_vector(image.polygon.span());
    const PolygonFan fan(image.polygon, area);
    const auto seed = hash(sampling.seed, image.emitter, index(image.world));
    const std::size_t begin = samples.size();
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto u = sobol4(sampling.first + k, seed);
      const Point3 y = point_on(fan, Vec2(u[0], u[1]));
      const Vec3 to = y - receiver.position;
      const double cosine = -glm::dot(to, image.normal) / std::max(glm::length(to), 1e-300);
      samples.push_back({to, std::max(0.0, cosine), image.weight * glm::length(area) / count,
                         emitter.area, Rgb(0.0), image.world});
      fold(light.scene, image.world,
           {receiver.position, y, receiver.plane_class, emitter.plane_class}, work.folded[k]);
    } // what solids bend, area lights by way of them too, rays find
    const std::uint32_t dark = blocked(light.scene, work.folded, count, work.shadow_rays);
    const Rgb radiance =
        light.worlds.worlds[index(image.world)].throughput * emitter.radiosity / std::numbers::pi;
    for (std::uint32_t k = 0; k < count; ++k)
      if (((dark >> k) & 1U) == 0)
        samples[begin + k].radiance = radiance * transmittance_by_angle(light.scene, work.folded[k]);
  }
}

} // namespace meninas
