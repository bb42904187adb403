#include "radiosity/direct_irradiance.h"

#include "radiosity/light_samples.h"
#include "radiosity/point_form_factor.h"
#include "radiosity/shadow_legs.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

double form_factor_share(const Receiver& receiver, const VirtualLight& image, const Point3& y) {
  const Vec3 to = y - receiver.position;
  const double distance2 = glm::dot(to, to);
  const double cosines =
      std::max(0.0, glm::dot(to, receiver.normal)) * std::max(0.0, -glm::dot(to, image.normal));
  return distance2 > 0.0 ? cosines / (distance2 * distance2) : 0.0;
}

namespace {

/// Sums of the weights of the samples so far, and of those that arrive.
struct VisibleShare {
  double all = 0.0;
  Rgb seen{0.0};
  int samples = 0, arrived = 0;
};

/// Adds samples number `begin` to `end` of one image to its visible share.
void sample_visibility(const LightScene& light, const VirtualLight& image, const Receiver& receiver,
                       int begin, int end, std::uint32_t seed, DirectWorkspace& work,
                       VisibleShare& share) {
  const Emitter& emitter = light.emitters[image.emitter];
  const Vec3 area = area_vector(image.polygon.span());
  for (int first = begin; first < end; first += 16) {
    const int count = std::min(16, end - first);
    std::array<double, 16> weight{};
    for (int k = 0; k < count; ++k) {
      const auto sample = sobol4(static_cast<std::uint32_t>(first + k), seed);
      const Point3 y = point_on(image.polygon, area, Vec2(sample[0], sample[1]));
      weight[static_cast<std::size_t>(k)] = form_factor_share(receiver, image, y);
      fold_legs(light.worlds, light.mirrors, image.world, receiver.position, receiver.plane_class,
                y, emitter.plane_class, work.folded[static_cast<std::size_t>(k)]);
    }
    const std::uint32_t dark =
        blocked(light, work.folded, static_cast<std::uint32_t>(count), work.shadow_rays);
    for (int k = 0; k < count; ++k) {
      share.all += weight[static_cast<std::size_t>(k)];
      if (((dark >> k) & 1U) == 0U)
        share.seen += weight[static_cast<std::size_t>(k)] *
                      left_by_glass(light, image.world, work.folded[static_cast<std::size_t>(k)]);
    }
    share.samples += count;
    share.arrived += count - std::popcount(dark);
  }
}

Rgb visible_fraction(const LightScene& light, const VirtualLight& image, const Receiver& receiver,
                     int samples, int penumbra_samples, std::uint32_t seed, DirectWorkspace& work) {
  VisibleShare share;
  sample_visibility(light, image, receiver, 0, samples, seed, work, share);
  const bool agree = share.arrived == 0 || share.arrived == share.samples;
  if (!agree && penumbra_samples > samples)
    sample_visibility(light, image, receiver, samples, penumbra_samples, seed, work, share);
  if (share.arrived == share.samples && light.glass.empty())
    return Rgb(1.0);
  return share.all > 0.0 ? share.seen / share.all : Rgb(0.0);
}

} // namespace

ArrivingLight direct_irradiance(const LightScene& light, const Receiver& receiver,
                                const DirectSettings& settings, std::uint32_t seed,
                                DirectWorkspace& work) {
  const Observer observer{receiver.position, receiver.normal, light.surfaces.tolerance};
  const LightChoice choice{static_cast<std::size_t>(settings.images),
                           0x1p-32 * hash(seed, 0xc401ce, 0)};
  chosen_lights(light.worlds, light.emitters, light.emitter_tree, observer, choice, work.choice,
                work.lights);

  // What every image would bring without blockers; brightest first.
  work.form_factors.clear();
  work.brought.clear();
  work.order.clear();
  for (const auto& image : work.lights) {
    const Rgb source = light.worlds.worlds[index(image.world)].throughput *
                       light.emitters[image.emitter].radiosity;
    work.form_factors.push_back(
        image.weight * point_form_factor(receiver.position, receiver.normal, image.polygon.span()));
    work.brought.push_back(work.form_factors.back() * largest(source));
    work.order.push_back(static_cast<std::uint32_t>(work.order.size()));
  }
  std::stable_sort(work.order.begin(), work.order.end(),
                   [&](auto a, auto b) { return work.brought[a] > work.brought[b]; });

  // An image is worth shadow rays by its share of what has arrived so far: a bright one that is hidden takes none from the others.
  ArrivingLight sum;
  for (const auto k : work.order) {
    if (work.brought[k] <= 0.0)
      break;
    const VirtualLight& image = work.lights[k];
    const double worth = work.brought[k] / std::max(work.brought[k], largest(sum.total));
    const int samples = std::max(1, static_cast<int>(std::lround(settings.shadow_rays * worth)));
    const int penumbra = static_cast<int>(std::lround(settings.penumbra_rays * worth));
    const auto image_seed = hash(seed, image.emitter, index(image.world));
    const Rgb visible =
        visible_fraction(light, image, receiver, samples, penumbra, image_seed, work);
    const Rgb arrived = visible * work.form_factors[k] *
                        light.worlds.worlds[index(image.world)].throughput *
                        light.emitters[image.emitter].radiosity;
    sum.total += arrived;
    if (image.world != real_world)
      sum.mirrored += arrived;
  }
  if (light.punctual.empty())
    return sum;
  std::vector<PunctualArrival> arrivals;
  punctual_arrivals(light, receiver, work, arrivals);
  for (const PunctualArrival& arrival : arrivals) {
    sum.total += arrival.irradiance;
    sum.punctual += arrival.irradiance;
    if (arrival.mirrors > 0)
      sum.mirrored += arrival.irradiance;
  }
  return sum;
}

} // namespace meninas
