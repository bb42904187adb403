#include "radiosity/light/shared_light.h"

#include "form_factors/point_form_factor.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/scene/small_elements.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The sums over the points so far.
struct PointSum {
  ArrivingLight punctual;
  ArrivedByLamp punctual_by_lamp = {};
  int points = 0, punctual_points = 0;
};

/// `caches_occluders`: of what blocks its rays.
std::uint32_t sum_of(SharedLightWorkspace& work, const Lighting& light, const VirtualLight& image,
                     int rays, bool caches_occluders) {
  const std::uint64_t key = (std::uint64_t{index(image.world)} << 32) | image.emitter;
  const auto [found, is_new] =
      work.image_of.try_emplace(key, static_cast<std::uint32_t>(work.images.size()));
  if (is_new)
    work.images.push_back({.source = light.worlds.worlds[index(image.world)].throughput *
                                     light.emitters[image.emitter].radiosity,
                           .world = image.world,
                           .emitter = image.emitter,
                           .from_a_point = static_cast<std::uint32_t>(rays),
                           .blockers = caches_occluders ? &work.blockers_of[key] : nullptr});
  return found->second;
}

/// The largest irradiance from one image at a point, as far as it is not known to be hidden.
double max_brought(const SharedLightWorkspace& work) {
  double most = 0.0;
  for (const ImageAtPoint& at : work.at_point) {
    const ImageSum& image = work.images[at.image];
    if (image.rays == 0 || image.seen > 0.0)
      most = std::max(most, brought_by(image, at.form_factor));
  }
  return most;
}

std::span<const ConvexPolygon> parts_of(const ImageAtPoint& at, const VirtualLight& image,
                                        const SharedLightWorkspace& work) {
  if (at.whole)
    return {&image.polygon, 1};
  return std::span(work.parts).subspan(at.first, at.parts);
}

double form_factor_of(const Receiver& receiver, std::span<const ConvexPolygon> parts) {
  double sum = 0.0;
  for (const ConvexPolygon& part : parts)
    sum += point_form_factor(receiver.position, receiver.normal, part.span());
  return sum;
}

/// The visible part of an image from the point, past cached occluders.
ImageAtPoint image_at(const Lighting& light, const Receiver& receiver, const VirtualLight& image,
                      std::uint32_t sum, SharedLightWorkspace& work) {
  ImageAtPoint at{.image = sum};
  if (image.afar > 0.0) {
    at.form_factor = image.afar;
    return at;
  }
  const ImageOccluders* blockers = work.images[sum].blockers;
  if (blockers && !blockers->known.empty()) {
    work.cutting.assign(1, image.polygon);
    for (const CachedOccluder& blocker : blockers->known)
      subtract(work.cutting, receiver.position, blocker, light.scene.surfaces.tolerance);
    at.whole = work.cutting.size() == 1 &&
               std::ranges::equal(work.cutting.front().span(), image.polygon.span());
    if (!at.whole) {
      at.first = work.parts.size();
      at.parts = work.cutting.size();
      work.parts.insert(work.parts.end(), work.cutting.begin(), work.cutting.end());
    }
  }
  at.form_factor = image.weight * form_factor_of(receiver, parts_of(at, image, work));
  return at;
}

/// An image at a point, and what it is worth beside the brightest one there.
struct WorthyImage {
  const VirtualLight& image;
  const ImageAtPoint& at;
  double worth; ///< up to 1
};

/// Sends the rays of one point towards what it sees of an image, as many as that is worth.
void add_rays(const Lighting& light, const Receiver& receiver, const WorthyImage& seen,
              std::uint32_t seed, SharedLightWorkspace& work) {
  const auto& [image, at, worth] = seen;
  ImageSum& total = work.images[at.image];
  const auto parts = parts_of(at, image, work);
  // One that stands for others of its lamp has them to share its rays with.
  const auto wanted = static_cast<std::uint32_t>(std::lround(total.from_a_point * worth));
  const auto rays = image.stands_for_others() ? 1U : std::max(1U, wanted);
  const Emitter& emitter = light.emitters[image.emitter];
  const Vec3 last = area_vector(parts.back().span());
  const double area = area_of(parts.first(parts.size() - 1)) + glm::length(last);
  const auto image_seed = hash(seed, image.emitter, index(image.world));
  const int mirrors = light.worlds.worlds[index(image.world)].depth;
  for (std::uint32_t k = 0; k < rays; ++k) {
    const Vec2 sample(sobol2(total.rays++, image_seed, SobolPair::second));
    const Point3 y = point_on(parts, area, last, sample);
    const double weight = image.afar > 0.0
                              ? image.afar
                              : image.weight * area / rays * form_factor_share(receiver, image, y);
    const Leg leg = shadow_leg(light.scene, emitter,
                               {receiver.position, y, none<PlaneId>, emitter.plane_class});
    work.waiting.rays.push_back({image.world, mirrors, at.image, leg.arriving, weight, leg.from, leg.to});
  }
}

/// Rays to the rim of what a point sees of an image, which count nothing and teach what hides it: the frame of a window
/// often hides a strip so thin that a few rays miss it, and all that they see would count as the whole.
void look_at_rim(const Lighting& light, const Receiver& receiver, const WorthyImage& seen,
                 SharedLightWorkspace& work) {
  constexpr double inset = 1e-3; // of the way to the middle
  constexpr std::uint32_t enough = 4; // as many as an element has corners
  const auto& [image, at, worth] = seen;
  ImageOccluders* blockers = work.images[at.image].blockers;
  if (!blockers || blockers->rims >= enough || blockers->too_many() || image.stands_for_others())
    return;
  ++blockers->rims;
  const Emitter& emitter = light.emitters[image.emitter];
  const int mirrors = light.worlds.worlds[index(image.world)].depth;
  for (const ConvexPolygon& part : parts_of(at, image, work)) {
    Point3 middle(0.0);
    for (const Point3& corner : part.span())
      middle += corner / double(part.size);
    for (const Point3& corner : part.span()) {
      const Leg leg = shadow_leg(light.scene, emitter,
                                 {receiver.position, glm::mix(corner, middle, inset), none<PlaneId>,
                                  emitter.plane_class});
      work.waiting.rays.push_back({image.world, mirrors, at.image, leg.arriving, 0.0, leg.from, leg.to});
    }
  }
}

/// The largest distance of two corners of an element.
double extent_of(const ElementMesh& mesh, ElementId element) {
  double most = 0.0;
  const ElementCorners& corners = mesh.corners[index(element)];
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = a + 1; b < corners.size(); ++b)
      most = std::max(most, glm::distance(mesh.vertices[index(corners[a])],
                                          mesh.vertices[index(corners[b])]));
  return most;
}

/// The images that a point may see, or a choice of them.
void find_lights(const Lighting& light, const NumberedPoint& point, std::uint32_t seed,
                 const SharedLightSettings& settings, SharedLightWorkspace& work) {
  work.point.lights.clear();
  if (light.emitters.empty())
    return;
  const Receiver& receiver = point.receiver;
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  const auto most = static_cast<std::size_t>(settings.images);
  const bool all = light.emitters.size() * light.worlds.worlds.size() <= most;
  const RegionImages* region = all && point.element != none<ElementId>
                                   ? images_of_element(light, point.element, work.elements)
                                   : nullptr;
  if (region) {
    lights_in_region(light.worlds, light.emitters, *region, observer, work.point.choice.seen,
                     work.point.lights);
    return;
  }
  // Where images are chosen, the steps through them begin elsewhere at every point,
  // evenly by the golden section.
  constexpr std::uint32_t golden_section = 0x9e3779b9;
  const double offset = 0x1p-32 * (hash(seed, 0xc401ce) + point.number * golden_section);
  LightChoice choice{most, offset, static_cast<std::size_t>(settings.rays)};
  choice.same_point = settings.one_place && point.number > 0;
  if (point.element != none<ElementId> && !settings.one_place) {
    choice.area = index(point.element) + std::uint64_t{1};
    choice.extent = extent_of(light.scene.mesh, point.element);
  }
  sample_light_tree({light.worlds, light.emitters, light.emitter_tree}, observer, choice,
                    work.point.choice, work.point.lights);
}

/// The largest number of points of a mean. Where each of them chooses a few of thousands of emitters the mean would
/// hardly settle: elements light others, and the errors of choices average out.
int points_limit(const Lighting& light, const SharedLightSettings& settings) {
  constexpr std::size_t few = 64; // of the emitters one of so many
  const bool hardly_settles =
      light.emitters.size() / few > static_cast<std::size_t>(settings.images);
  return hardly_settles && !settings.one_place ? std::max(settings.points, reduced_count(settings.max_points))
                                           : settings.max_points;
}

/// Adds what every image brings to a point past known blockers,
/// and the shadow rays that will tell how much of it arrives.
void add_point(const Lighting& light, const NumberedPoint& point, std::uint32_t seed,
               const SharedLightSettings& settings, SharedLightWorkspace& work) {
  const Receiver& receiver = point.receiver;
  const auto are_all = [&] {
    return std::ranges::none_of(work.point.lights, &VirtualLight::stands_for_others);
  };
  const bool knows_images = settings.one_place && point.number > 0 && are_all();
  if (!knows_images) {
    find_lights(light, point, seed, settings, work);
    work.at_point.clear();
    work.parts.clear();
    // An image that is one of a choice has too few rays to learn from.
    const bool caches_occluders = settings.caches_occluders && are_all();
    for (const VirtualLight& image : work.point.lights)
      work.at_point.push_back(
          image_at(light, receiver, image, sum_of(work, light, image, settings.rays, caches_occluders), work));
  }
  const double most = settings.rays_by_brightness ? max_brought(work) : 0.0;

  for (std::size_t i = 0; i < work.at_point.size(); ++i) {
    const ImageAtPoint& at = work.at_point[i];
    if (at.form_factor <= 0.0)
      continue;
    ImageSum& total = work.images[at.image];
    total.form_factor += at.form_factor;
    const double worth = most > 0.0 ? std::min(brought_by(total, at.form_factor) / most, 1.0) : 1.0;
    const WorthyImage seen{work.point.lights[i], at, worth};
    if (!knows_images)
      look_at_rim(light, receiver, seen, work);
    add_rays(light, receiver, seen, seed, work);
  }
}

/// The mean so far, by lamp in the workspace.
ArrivingLight mean_of(const Lighting& light, SharedLightWorkspace& work, const PointSum& sum) {
  const double points = sum.points, lit = std::max(sum.punctual_points, 1);
  const ArrivingLight& p = sum.punctual;
  ArrivingLight mean{p.total / lit, p.mirrored / lit, p.punctual / lit, p.entering / lit};
  work.point.by_lamp = sum.punctual_by_lamp;
  for (Rgb& part : work.point.by_lamp)
    part /= lit;
  for (const ImageSum& image : work.images) {
    const Rgb visible = image.all > 0.0 ? image.left / image.all : Rgb(0.0);
    const Rgb arrived = visible * image.form_factor / points * image.source;
    mean.total += arrived;
    if (light.lamps)
      add_of_emitter(*light.lamps, image.emitter, arrived, work.point.by_lamp);
    if (image.world != real_world)
      mean.mirrored += arrived;
    if (light.emitters[image.emitter].area_light != no_area_light)
      mean.entering += arrived;
  }
  return mean;
}

/// About the error of the mean by the shadow rays' choice.
double penumbra_error(const Lighting& light, const SharedLightWorkspace& work, const PointSum& sum) {
  double error = 0.0;
  for (const ImageSum& image : work.images) {
    const double brought = brought_by(image, image.form_factor / sum.points);
    if (image.rays > 0)
      error += variance_of(light, image) * std::pow(image.rays, -1.5) * brought * brought;
  }
  return std::sqrt(error);
}

void add_punctual(const Lighting& light, const Receiver& receiver, PointSum& sum,
                  SharedLightWorkspace& work) {
  if (light.punctual.empty())
    return;
  ++sum.punctual_points;
  punctual_arrivals(light, receiver, work.point, work.arrivals);
  for (const PunctualArrival& arrival : work.arrivals) {
    const auto is_of = [&](const SpotPart& part) {
      return part.light == arrival.light && part.world == arrival.world;
    };
    if (std::ranges::any_of(work.spots, is_of))
      continue;
    if (light.lamps)
      sum.punctual_by_lamp[light.lamps->of_punctual[arrival.light]] += arrival.irradiance;
    const Rgb mirrored = arrival.world != real_world ? arrival.irradiance : Rgb(0.0);
    sum.punctual = sum.punctual + ArrivingLight{arrival.irradiance, mirrored, arrival.irradiance,
                                               arrival.irradiance};
  }
}

/// The mean over the points that have been collected, all in the receiver's plane.
SolidLight light_by_solids(const Lighting& light, const Receiver& last, int rays,
                           std::uint32_t seed, DirectWorkspace& work) {
  if (!has_solid_light(light))
    return {};
  return solid_light(light.scene,
                     {work.solids.points, last.normal, last.plane_class, last.tangent, last.coat}, rays,
                     seed, work.shadow_rays, work.solids);
}

} // namespace

ArrivingLight mean_direct_irradiance(const Lighting& light, const NextPoint& next_point,
                                const SharedLightSettings& settings, std::uint32_t seed,
                                SharedLightWorkspace& work) {
  work.images.clear();
  work.image_of.clear();
  work.point.choice.area = 0;
  PointSum sum;
  sum.punctual_by_lamp.assign(light.lamps ? light.lamps->count : 0, Rgb(0.0));
  auto& solid_points = work.point.solids.points;
  solid_points.clear();
  Rgb before(0.0);
  const int most = points_limit(light, settings);
  int wanted = std::min(settings.points, most);
  for (;;) {
    const NumberedPoint next = next_point();
    add_point(light, next, seed, settings, work);
    solid_points.push_back(next.receiver.position);
    if (!settings.one_place || sum.points == 0)
      add_punctual(light, next.receiver, sum, work);
    if (++sum.points < wanted)
      continue;

    // Between the first half of the points and all
    // of them the mean has moved by about its own error.
    trace_waiting(light, next.receiver, work.waiting, work.images, work.point);
    const ArrivingLight mean = mean_of(light, work, sum);
    const double brightest = largest(mean.total);
    const bool has_settled = sum.points > settings.points &&
                         largest(glm::abs(mean.total - before)) <= settings.unsure * brightest &&
                         penumbra_error(light, work, sum) <= settings.unsure_shadow * brightest;
    const bool dark = sum.points >= 2 * settings.points && brightest == 0.0;
    if (has_settled || dark || sum.points >= most) {
      work.has_new_occluders = cache_occluders(work.images);
      work.shadow_error = penumbra_error(light, work, sum);
      const SolidLight by_solids =
          light_by_solids(light, next.receiver, settings.solid_rays, seed, work.point);
      for (std::size_t l = 0; l < by_solids.by_lamp.size(); ++l)
        work.point.by_lamp[l] += by_solids.by_lamp[l];
      return mean + ArrivingLight{by_solids.total, by_solids.mirrored};
    }
    before = mean.total;
    const auto of_penumbra = static_cast<std::uint32_t>(settings.penumbra_rays);
    for (ImageSum& image : work.images)
      image.from_a_point = shows_differences(light, image) ? of_penumbra : 1;
    wanted = std::min(2 * sum.points, most);
  }
}

} // namespace meninas
