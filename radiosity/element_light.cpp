#include "radiosity/element_light.h"

#include "radiosity/point_form_factor.h"
#include "radiosity/shadow_legs.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace meninas {

namespace {

/// Light of an element under way, of punctual lights: sums over `points`.
struct ElementSum {
  ArrivingLight punctual;
  int points = 0;
};

std::uint32_t sum_of(ElementWorkspace& work, const LightScene& light, const VirtualLight& image,
                     int rays) {
  const std::uint64_t key = (std::uint64_t{index(image.world)} << 32) | image.emitter;
  const auto [found, is_new] =
      work.image_of.try_emplace(key, static_cast<std::uint32_t>(work.images.size()));
  if (is_new)
    work.images.push_back({.source = light.worlds.worlds[index(image.world)].throughput *
                                     light.emitters[image.emitter].radiosity,
                           .world = image.world,
                           .from_a_point = static_cast<std::uint32_t>(rays)});
  return found->second;
}

/// Adds what every image brings to a point without blockers, and the shadow rays that will tell how much of it arrives.
void add_point(const LightScene& light, const Receiver& receiver, std::uint32_t point,
               std::uint32_t seed, const DirectSettings& settings, ElementWorkspace& work) {
  const Observer observer{receiver.position, receiver.normal, light.surfaces.tolerance};
  // Where images are chosen, the steps through them begin elsewhere at every point, evenly by the golden section.
  constexpr std::uint32_t golden_section = 0x9e3779b9;
  const LightChoice choice{static_cast<std::size_t>(settings.images_in_element),
                           0x1p-32 * (hash(seed, 0xc401ce) + point * golden_section)};
  chosen_lights(light.worlds, light.emitters, light.emitter_tree, observer, choice,
                work.point.choice, work.point.lights);
  for (const VirtualLight& image : work.point.lights) {
    const double form_factor =
        image.weight * point_form_factor(receiver.position, receiver.normal, image.polygon.span());
    if (form_factor <= 0.0)
      continue;
    const std::uint32_t sum = sum_of(work, light, image, settings.rays_in_element);
    work.images[sum].form_factor += form_factor;
    const std::uint32_t rays = work.images[sum].from_a_point;
    const Emitter& emitter = light.emitters[image.emitter];
    const Vec3 area = area_vector(image.polygon.span());
    const auto image_seed = hash(seed, image.emitter, index(image.world));
    for (std::uint32_t k = 0; k < rays; ++k) {
      const auto sample = sobol4(work.images[sum].rays++, image_seed);
      const Point3 y = point_on(image.polygon, area, Vec2(sample[2], sample[3]));
      const double weight =
          image.weight * glm::length(area) / rays * form_factor_share(receiver, image, y);
      work.waiting.push_back({image.world, sum, emitter.plane_class, weight, receiver.position, y});
    }
  }
}

/// Traces the waiting rays, those of one world together.
void trace_waiting(const LightScene& light, PlaneId leaving, ElementWorkspace& work) {
  std::ranges::stable_sort(work.waiting, {}, [](const WaitingRay& ray) { return ray.world; });
  for (std::size_t first = 0; first < work.waiting.size();) {
    const WorldId world = work.waiting[first].world;
    std::uint32_t count = 0;
    while (count < 16 && first + count < work.waiting.size() &&
           work.waiting[first + count].world == world) {
      const WaitingRay& ray = work.waiting[first + count];
      fold_legs(light.worlds, light.mirrors, world, ray.from, leaving, ray.to, ray.arriving,
                work.point.folded[count]);
      ++count;
    }
    const std::uint32_t dark = blocked(light, work.point.folded, count, work.point.shadow_rays);
    for (std::uint32_t k = 0; k < count; ++k) {
      const WaitingRay& ray = work.waiting[first + k];
      ImageSum& image = work.images[ray.image];
      image.all += ray.weight;
      if (((dark >> k) & 1U) != 0U)
        continue;
      image.seen += ray.weight;
      image.left += ray.weight * left_by_glass(light, world, work.point.folded[k]);
    }
    first += count;
  }
  work.waiting.clear();
}

/// The mean so far.
ArrivingLight mean_of(const ElementWorkspace& work, const ElementSum& sum) {
  const double points = sum.points;
  ArrivingLight mean{sum.punctual.total / points, sum.punctual.mirrored / points,
                     sum.punctual.punctual / points};
  for (const ImageSum& image : work.images) {
    const Rgb visible = image.all > 0.0 ? image.left / image.all : Rgb(0.0);
    const Rgb arrived = visible * image.form_factor / points * image.source;
    mean.total += arrived;
    if (image.world != real_world)
      mean.mirrored += arrived;
  }
  return mean;
}

/// About the error of the mean by the shadow rays' choice.
double penumbra_error(const ElementWorkspace& work, const ElementSum& sum) {
  double error = 0.0;
  for (const ImageSum& image : work.images) {
    const double visible = image.all > 0.0 ? image.seen / image.all : 0.0;
    const double brought = image.form_factor / sum.points * largest(image.source);
    error += visible * (1.0 - visible) * std::pow(image.rays, -1.5) * brought * brought;
  }
  return std::sqrt(error);
}

constexpr double unsure = 0.01;            ///< relative change of the mean by the last doubling
constexpr double unsure_shadow = 0.005;    ///< error of the mean by shadow rays, relative
constexpr std::uint32_t penumbra_rays = 4; ///< from each point to an image that is seen in part

} // namespace

ArrivingLight direct_irradiance(const LightScene& light, ElementId element, CoveredCells covered,
                                const DirectSettings& settings, ElementWorkspace& work) {
  constexpr int whole = 64;
  if (std::popcount(covered) == whole)
    return {};
  const ReceiverArea area = receiver_of(light, element);
  const auto seed = hash(index(element), settings.seed, 0xd17ec7);
  work.images.clear();
  work.image_of.clear();
  ElementSum sum;
  Rgb before(0.0);
  int wanted = settings.points;
  for (std::uint32_t p = 0;; ++p) {
    const auto sample = sobol4(p, seed);
    if (is_covered(covered, sample[0], sample[1]))
      continue;
    const Receiver receiver{point_in(area, Vec2(sample[0], sample[1])), area.normal,
                            area.plane_class};
    add_point(light, receiver, p, seed, settings, work);
    if (!light.punctual.empty()) {
      punctual_arrivals(light, receiver, work.point, work.arrivals);
      for (const PunctualArrival& arrival : work.arrivals)
        sum.punctual =
            sum.punctual + ArrivingLight{arrival.irradiance,
                                         arrival.mirrored ? arrival.irradiance : Rgb(0.0),
                                         arrival.irradiance};
    }
    if (++sum.points < wanted)
      continue;

    // Between the first half of the points and all of them the mean has moved by about its own error.
    trace_waiting(light, area.plane_class, work);
    const ArrivingLight mean = mean_of(work, sum);
    const bool settled = sum.points > settings.points &&
                         largest(glm::abs(mean.total - before)) <= unsure * largest(mean.total) &&
                         penumbra_error(work, sum) <= unsure_shadow * largest(mean.total);
    const bool dark = sum.points >= 2 * settings.points && largest(mean.total) == 0.0;
    if (settled || dark || 2 * sum.points > settings.most_points)
      return mean;
    before = mean.total;
    for (ImageSum& image : work.images)
      image.from_a_point = image.seen > 0.0 && image.seen < image.all ? penumbra_rays : 1;
    wanted = 2 * sum.points;
  }
}

DirectIrradiance direct_irradiance(const LightScene& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress) {
  constexpr std::size_t chunk_size = 64;
  const std::size_t size = element_count(light.mesh);
  DirectIrradiance result;
  result.irradiance.assign(size, Rgb(0.0));
  if (light.emitters.empty() && light.punctual.empty())
    return result;
  result.punctual.resize(light.punctual.empty() ? 0 : size);

  const std::size_t chunks = (size + chunk_size - 1) / chunk_size;
  tbb::enumerable_thread_specific<ElementWorkspace> workspaces;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    ElementWorkspace& work = workspaces.local();
    const std::size_t end = std::min(size, (c + 1) * chunk_size);
    for (std::size_t i = c * chunk_size; i < end; ++i) {
      const ArrivingLight mean = direct_irradiance(
          light, static_cast<ElementId>(i), covered.empty() ? 0 : covered[i], settings, work);
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
