#include "radiosity/light/direct_irradiance.h"

#include "radiosity/light/light_samples.h"
#include "form_factors/point_form_factor.h"
#include "radiosity/light/portal_light.h"
#include "radiosity/light/virtual_light_visibility.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace meninas {

double form_factor_share(const Receiver& receiver, const Direction& normal, const Point3& y) {
  const Vec3 to = y - receiver.position;
  const double distance2 = glm::dot(to, to);
  const double cosines =
      std::max(0.0, glm::dot(to, receiver.normal)) * std::max(0.0, -glm::dot(to, normal));
  return distance2 > 0.0 ? cosines / (distance2 * distance2) : 0.0;
}

namespace {

bool agree(const VisibleShare& share) {
  return share.arrived == 0 || share.arrived == share.samples;
}

/// Whether it matters of each sample what arrives of it, not only whether.
bool are_weighed(const Lighting& light, const Emitter& emitter) {
  return !light.scene.by_angle.empty() || is_uneven(light.scene, emitter);
}

/// The samples of one image from a point.
struct ImageSampling {
  std::uint32_t seed;
  PolygonFan fan;

  Point3 point(int k) const {
    return point_on(fan, Vec2(sobol2(static_cast<std::uint32_t>(k), seed, SobolPair::first)));
  }
};

/// One image as a point sees it; the seed is that of all images there.
struct ImageFromPoint {
  const VirtualLight& image;
  const Receiver& receiver;
  std::uint32_t seed;
};

/// Adds the samples of one image up to number `end` to its visible share.
/// Weights are needed where some arrive and some do not, or panes take their part of each;
/// those of samples before, which all arrived or all did not, are found when one is met that differs.
void sample_visibility(const Lighting& light, const ImageFromPoint& from, int end,
                       DirectWorkspace& work, VisibleShare& share) {
  const auto& [image, receiver, seed] = from;
  const Emitter& emitter = light.emitters[image.emitter];
  const bool weighs = are_weighed(light, emitter);
  const ImageSampling sampling{hash(seed, image.emitter, index(image.world)),
                               PolygonFan(image.polygon, area_vector(image.polygon.span()))};
  for (int first = share.samples; first < end; first += 16) {
    const int count = std::min(16, end - first);
    std::array<Point3, 16> points;
    for (int k = 0; k < count; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      points[lane] = sampling.point(first + k);
      fold(light.scene, image.world,
           shadow_leg(light.scene, emitter,
                      {receiver.position, points[lane], receiver.plane_class, emitter.plane_class}),
           work.folded[lane], solids_before(emitter));
    }
    const std::uint32_t dark =
        blocked(light.scene, work.folded, static_cast<std::uint32_t>(count), work.shadow_rays);
    const bool were_seen = share.arrived > 0;
    share.samples += count;
    share.arrived += count - std::popcount(dark);
    if (agree(share) && !weighs)
      continue;
    for (; share.weighed < first; ++share.weighed) {
      const double weight = form_factor_share(receiver, image, sampling.point(share.weighed));
      share.all += weight;
      if (were_seen)
        share.seen += weight;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const double weight = form_factor_share(receiver, image, points[k]);
      share.all += weight;
      if (((dark >> k) & 1U) == 0U)
        share.seen +=
            weight * transmittance_between(light.scene, end_of(receiver), end_of(emitter), work.folded[k]) *
            shown_by(light.scene, emitter, work.folded[k]);
    }
    share.weighed = share.samples;
  }
}

Rgb visible_fraction(const Lighting& light, const Emitter& emitter, const VisibleShare& share) {
  if (agree(share) && !are_weighed(light, emitter))
    return Rgb(share.arrived > 0 ? 1.0 : 0.0);
  return share.all > 0.0 ? share.seen / share.all : Rgb(0.0);
}

/// The radiosity of an image as it is seen, tau E.
Rgb source_of(const Lighting& light, const VirtualLight& image) {
  return light.worlds.worlds[index(image.world)].throughput *
         light.emitters[image.emitter].radiosity;
}

/// The irradiance from every image without blockers; images that bring nothing are left out.
void order_by_light(const Lighting& light, const Receiver& receiver, DirectWorkspace& work) {
  work.form_factors.clear();
  work.brought.clear();
  work.order.clear();
  work.sampled.clear();
  work.dim.clear();
  work.by_lamp.assign(light.lamps ? light.lamps->count : 0, Rgb(0.0));
  for (std::uint32_t k = 0; k < work.lights.size(); ++k) {
    const VirtualLight& image = work.lights[k];
    work.form_factors.push_back(
        image.afar > 0.0 ? image.afar
                         : image.weight * point_form_factor(receiver.position, receiver.normal,
                                                            image.polygon.span()));
    work.brought.push_back(work.form_factors.back() * largest(source_of(light, image)));
    if (work.brought.back() > 0.0)
      work.order.push_back(k);
  }
  std::stable_sort(work.order.begin(), work.order.end(),
                   [&](auto a, auto b) { return work.brought[a] > work.brought[b]; });
}

/// Whether what is computed is a choice of the images.
bool stand_for_others(const DirectWorkspace& work) {
  return std::ranges::any_of(work.lights,
                             [](const VirtualLight& image) { return image.stands_for_others(); });
}

/// The visibility of each of the dim images, by its one sample:
/// sixteen rays together that have as many legs.
void sample_dim_images(const Lighting& light, const Receiver& receiver,
                       std::span<std::uint32_t> dim, std::uint32_t seed, DirectWorkspace& work) {
  const auto depth_of = [&](std::uint32_t k) {
    return light.worlds.worlds[index(work.lights[k].world)].depth;
  };
  work.visible.assign(work.lights.size(), Rgb(0.0));
  std::ranges::stable_sort(dim, {}, depth_of);
  for (std::size_t first = 0; first < dim.size();) {
    std::array<double, 16> weight{};
    std::uint32_t count = 0;
    for (; count < 16 && first + count < dim.size() &&
           depth_of(dim[first + count]) == depth_of(dim[first]);
         ++count) {
      const VirtualLight& image = work.lights[dim[first + count]];
      const Emitter& emitter = light.emitters[image.emitter];
      const Vec2 sample(sobol2(0, hash(seed, image.emitter, index(image.world)), SobolPair::first));
      const Point3 y = point_on(image.polygon, area_vector(image.polygon.span()), sample);
      if (!light.scene.by_angle.empty())
        weight[count] = form_factor_share(receiver, image, y);
      fold(light.scene, image.world,
           shadow_leg(light.scene, emitter,
                      {receiver.position, y, receiver.plane_class, emitter.plane_class}),
           work.folded[count], solids_before(emitter));
    }
    const std::uint32_t dark = blocked(light.scene, work.folded, count, work.shadow_rays);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t own = dim[first + k];
      const Emitter& emitter = light.emitters[work.lights[own].emitter];
      if (((dark >> k) & 1U) == 0U && (light.scene.by_angle.empty() || weight[k] > 0.0))
        work.visible[own] =
            transmittance_between(light.scene, end_of(receiver), end_of(emitter), work.folded[k]) *
            shown_by(light.scene, emitter, work.folded[k]);
    }
    first += count;
  }
}

} // namespace

ArrivingLight images_irradiance(const Lighting& light, const Receiver& receiver,
                                const DirectSettings& settings, std::uint32_t seed,
                                DirectWorkspace& work) {
  order_by_light(light, receiver, work);

  // An image is worth shadow rays by its share of what has arrived so far: a bright one that is hidden
  // takes none from the others. One of a choice has its share of all: there are many, and none stands out.
  ArrivingLight sum;
  const bool everywhere = settings.penumbra_samples == PenumbraSamples::everywhere;
  const auto add = [&](std::uint32_t k, const Rgb& visible) {
    const VirtualLight& image = work.lights[k];
    const Rgb arrived = visible * work.form_factors[k] *
                        light.worlds.worlds[index(image.world)].throughput *
                        light.emitters[image.emitter].radiosity;
    sum.total += arrived;
    if (light.lamps)
      add_of_emitter(*light.lamps, image.emitter, arrived, work.by_lamp);
    sum.mirrored += image.world != real_world ? arrived : Rgb(0.0);
    sum.entering += light.emitters[image.emitter].area_light != no_area_light ? arrived : Rgb(0.0);
  };
  // One that stands for others of its group has them to share its shadow rays with: it takes one.
  const double all =
      stand_for_others(work) ? std::accumulate(work.brought.begin(), work.brought.end(), 0.0) : 0.0;
  for (const std::uint32_t k : work.order) {
    const VirtualLight& image = work.lights[k];
    const double worth = work.brought[k] / std::max({work.brought[k], largest(sum.total), all});
    const int samples = std::max(1, static_cast<int>(std::lround(settings.shadow_rays * worth)));
    if (samples == 1 || image.stands_for_others()) {
      work.dim.push_back(k);
      continue;
    }
    SampledImage sampled{k, static_cast<int>(std::lround(settings.penumbra_rays * worth)), {}};
    sample_visibility(light, {image, receiver, seed}, samples, work, sampled.share);
    if (everywhere || !agree(sampled.share))
      sample_visibility(light, {image, receiver, seed}, sampled.penumbra_samples, work,
                        sampled.share);
    add(k, visible_fraction(light, light.emitters[image.emitter], sampled.share));
    sum.in_part = sum.in_part || !agree(sampled.share);
    work.sampled.push_back(sampled);
  }

  // Beside an edge the other images may have edges too, which few samples have missed.
  if (settings.penumbra_samples == PenumbraSamples::together && sum.in_part) {
    sum = {.in_part = true};
    std::ranges::fill(work.by_lamp, Rgb(0.0));
    for (SampledImage& sampled : work.sampled) {
      sample_visibility(light, {work.lights[sampled.light], receiver, seed},
                        sampled.penumbra_samples, work, sampled.share);
      add(sampled.light,
          visible_fraction(light, light.emitters[work.lights[sampled.light].emitter],
                           sampled.share));
    }
  }

  sample_dim_images(light, receiver, work.dim, seed, work);
  for (const std::uint32_t k : work.order)
    if (work.visible[k] != Rgb(0.0))
      add(k, work.visible[k]);
  return sum;
}

/// Whether of the images that stand for others some are hidden and some are not.
static bool groups_in_part(const DirectWorkspace& work) {
  bool hidden = false, seen = false;
  for (const std::uint32_t k : work.dim)
    if (work.lights[k].stands_for_others())
      (work.visible[k] == Rgb(0.0) ? hidden : seen) = true;
  return hidden && seen;
}

/// The mean of two choices of images at a point, by lamp in the workspace, where that has the second.
static ArrivingLight mean_of_choices(const ArrivingLight& first, const ArrivedByLamp& first_by_lamp,
                                     const ArrivingLight& second, double share, DirectWorkspace& work) {
  ArrivingLight mean = first;
  mean.total = glm::mix(first.total, second.total, share);
  mean.mirrored = glm::mix(first.mirrored, second.mirrored, share);
  mean.entering = glm::mix(first.entering, second.entering, share);
  mean.in_part = first.in_part || second.in_part;
  for (std::size_t l = 0; l < work.by_lamp.size(); ++l)
    work.by_lamp[l] = glm::mix(first_by_lamp[l], work.by_lamp[l], share);
  return mean;
}

/// The irradiance from the images of emitters, or from a choice of them. If many images stand for a lamp, and some
/// are hidden and some are not, more are chosen, up to the number of samples that a penumbra takes.
static ArrivingLight chosen_irradiance(const Lighting& light, const Receiver& receiver,
                                       const DirectSettings& settings, std::uint32_t seed,
                                       DirectWorkspace& work) {
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  const auto choose = [&](int rays, bool again) {
    const LightChoice choice{static_cast<std::size_t>(settings.images),
                             0x1p-32 * hash(seed, 0xc401ce, again ? 1 : 0),
                             static_cast<std::size_t>(rays), 0, 0.0, again};
    sample_light_tree({light.worlds, light.emitters, light.emitter_tree}, observer, choice,
                      work.choice, work.lights);
    return images_irradiance(light, receiver, settings, seed, work);
  };
  const bool everywhere = settings.penumbra_samples == PenumbraSamples::everywhere;
  const int rays = everywhere ? settings.penumbra_rays : settings.shadow_rays;
  ArrivingLight sum = choose(rays, false);
  if (!stand_for_others(work))
    return sum;
  const bool in_part = groups_in_part(work);
  sum.in_part = sum.in_part || in_part;
  const int more = settings.penumbra_rays - rays;
  if (!in_part || more <= 0)
    return sum;
  const ArrivedByLamp by_lamp = work.by_lamp;
  return mean_of_choices(sum, by_lamp, choose(more, true), double(more) / settings.penumbra_rays, work);
}

ArrivingLight direct_irradiance(const Lighting& light, const Receiver& receiver,
                                const DirectSettings& settings, std::uint32_t seed,
                                DirectWorkspace& work) {
  ArrivingLight sum = chosen_irradiance(light, receiver, settings, seed, work);
  if (has_solid_light(light)) {
    const SolidLight refracted =
        solid_light(light.scene,
                    {{&receiver.position, 1},
                     receiver.normal,
                     receiver.plane_class,
                     receiver.tangent,
                     receiver.coat},
                    settings.solid_rays, seed, work.shadow_rays, work.solids);
    sum = sum + ArrivingLight{refracted.total, refracted.mirrored};
    for (std::size_t l = 0; l < work.by_lamp.size(); ++l)
      work.by_lamp[l] += refracted.by_lamp[l];
  }
  if (light.punctual.empty())
    return sum;
  std::vector<PunctualArrival> arrivals;
  punctual_arrivals(light, receiver, work, arrivals);
  for (const PunctualArrival& arrival : arrivals) {
    sum.total += arrival.irradiance;
    sum.punctual += arrival.irradiance;
    sum.entering += arrival.irradiance;
    if (light.lamps)
      work.by_lamp[light.lamps->of_punctual[arrival.light]] += arrival.irradiance;
    if (arrival.world != real_world)
      sum.mirrored += arrival.irradiance;
  }
  return sum;
}

Rgb unblocked_irradiance(const Lighting& light, const DirectWorkspace& work) {
  Rgb sum(0.0);
  for (std::size_t k = 0; k < work.lights.size(); ++k)
    sum += work.form_factors[k] * source_of(light, work.lights[k]);
  return sum;
}

} // namespace meninas
