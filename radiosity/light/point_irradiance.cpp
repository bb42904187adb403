#include "radiosity/light/point_irradiance.h"

#include "radiosity/light/row_cache.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

namespace meninas {

namespace {

DirectSettings cluster_settings(DirectSettings direct, int shadow_rays) {
  direct.shadow_rays = shadow_rays;
  direct.penumbra_rays = 4 * shadow_rays;
  direct.penumbra_samples = PenumbraSamples::own;
  direct.images = std::numeric_limits<int>::max(); // there are not many, by construction
  return direct;
}

/// The light of landed rays: light reflected by elements,
/// where no cluster owns it, and emission, where no closed form owns that.
PointLight landed_light(const PointGathering& gathering, const GatheredRays& gathered,
                        ArrivedByLamp& by_lamp) {
  const std::size_t cluster_worlds = gathering.clusters.worlds.worlds.size();
  ArrivingLight sum, emission;
  std::uint32_t hits = 0;
  for (const auto& landing : gathered.landings) {
    const bool owned =
        gathering.clusters.owned[landing.element] != 0 && index(landing.world) < cluster_worlds;
    const Rgb emitted = gathered_emission(gathering.light, landing);
    Rgb arrived = emitted;
    if (!owned)
      arrived += Rgb(landing.light) * gathering.reflected[landing.element];
    if (!owned && !by_lamp.empty())
      add_shares(gathering.reflected_by_lamp, landing.element, Rgb(landing.light), by_lamp);
    if (emitted != Rgb(0.0) && !by_lamp.empty())
      by_lamp[gathering.light.lamps.of_side[index(gathering.light.mesh.side_of_element[landing.element])]] +=
          emitted;
    const bool by_mirrors = landing.world != real_world && landing.world != through_solids;
    sum.total += arrived;
    if (by_mirrors)
      sum.mirrored += arrived;
    if (emitted == Rgb(0.0))
      continue;
    ++hits;
    emission.total += emitted;
    if (by_mirrors)
      emission.mirrored += emitted;
  }
  const Rgb straight = gathering.light.background * Rgb(gathered.escaped_straight - gathered.owned_straight) +
                       std::numbers::pi * Rgb(gathered.sky_straight);
  const Rgb by_mirrors = gathering.light.background * Rgb(gathered.escaped_light - gathered.owned_light) +
                         std::numbers::pi * Rgb(gathered.sky) - straight;
  sum.total += straight + by_mirrors;
  sum.mirrored += by_mirrors;
  const Rgb kept = kept_light(gathered);
  PointLight light;
  light.from_rays = {sum.total / kept, sum.mirrored / kept};
  light.emission = {emission.total / kept, emission.mirrored / kept};
  light.sky = {(straight + by_mirrors) / kept, by_mirrors / kept};
  light.hits = hits;
  if (!by_lamp.empty())
    by_lamp[gathering.light.lamps.sky] += straight + by_mirrors;
  for (Rgb& part : by_lamp)
    part /= kept;
  return light;
}

/// The share of each lamp in the light of each cluster, and of each node of their tree.
LampShares shares_of_clusters(const LightScene& light, const SecondaryEmitters& clusters,
                              const ClusterTree& tree, const SharesByLamp& reflected) {
  LampShares lamps;
  if (reflected.rows == 0)
    return lamps;
  lamps.count = light.lamps.count;
  const auto power_of = [&](std::uint32_t cluster) {
    std::vector<double> power(reflected.columns, 0.0);
    for (const std::uint32_t e : clusters.elements[cluster])
      for (std::size_t k = 0; k < power.size(); ++k)
        power[k] += light.mesh.area[e] * double{light.mesh.solid[e]} * double{reflected[e][k]};
    return power;
  };
  const auto set_shares = [](std::span<const double> power, std::span<float> shares) {
    for (std::size_t band = 0; band < 3; ++band) {
      double sum = 0.0;
      for (std::size_t k = band; k < power.size(); k += 3)
        sum += power[k];
      for (std::size_t k = band; k < power.size(); k += 3)
        shares[k] = sum > 0.0 ? static_cast<float>(power[k] / sum) : 0.0F;
    }
  };
  lamps.of_cluster = {.rows = clusters.emitters.size(), .columns = reflected.columns};
  lamps.of_node = {.rows = tree.nodes.size(), .columns = reflected.columns};
  std::vector<std::vector<double>> powers;
  for (std::uint32_t c = 0; c < clusters.emitters.size(); ++c) {
    powers.push_back(power_of(c));
    set_shares(powers.back(), lamps.of_cluster[c]);
  }
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    std::vector<double> power(reflected.columns, 0.0);
    for (std::uint32_t k = 0; k < tree.nodes[n].count; ++k)
      std::ranges::transform(power, powers[tree.order[tree.nodes[n].first + k]], power.begin(),
                             std::plus{});
    set_shares(power, lamps.of_node[n]);
  }
  return lamps;
}

} // namespace

PointGathering::PointGathering(const LightScene& scene, SentLight sent,
                               const FormFactorSettings& factors,
                               const DirectSettings& direct_light,
                               const PointGatheringSettings& settings)
    : light(scene), reflected(std::move(sent.all)), reflected_by_lamp(std::move(sent.by_lamp)),
      form_factors(factors), direct(direct_light),
      secondary(cluster_settings(direct_light, settings.cluster_shadow_rays)),
      cut{settings.cluster_theta, std::max(8 * settings.cluster_shadow_rays, settings.rays / 8)},
      clusters(find_secondary_emitters(scene, reflected, {.spared = settings.clusters_spared})),
      cluster_tree(make_cluster_tree(clusters.emitters)),
      cluster_emitters(make_emitter_tree(clusters.emitters)),
      lamps(shares_of_clusters(scene, clusters, cluster_tree, reflected_by_lamp)),
      secondary_lighting(scene, clusters.worlds, clusters.emitters, cluster_emitters),
      net(make_direction_net(settings.rays)),
      others(settings.rays_before > 0 && settings.rays_before < settings.rays
                 ? make_direction_net(settings.rays, settings.rays_before)
                 : HemisphereSamples{}),
      cube(factors.method == FormFactorMethod::hemicube ? make_hemicube(factors.hemicube_resolution)
                                                        : Hemicube{}) {
  secondary_lighting.lamps = lamps ? &lamps : nullptr;
}

ReceiverArea area_of(const Receiver& point) {
  ReceiverArea area;
  area.corner = point.position;
  area.normal = point.normal;
  area.plane_class = point.plane_class;
  area.tangent = point.tangent;
  area.coat = point.coat;
  return area;
}

/// The hits of all rays of the point, those that were traced before among them.
static void gather_rays_at(const PointGathering& gathering, const Receiver& receiver,
                           std::uint32_t seed, const GatheredRays* before, PointWorkspace& work) {
  const ReceiverArea point = area_of(receiver);
  if (gathering.form_factors.method == FormFactorMethod::hemicube) {
    gather_rays(gathering.light, gathering.cube, point, gathering.form_factors, work.gather);
  } else if (before == nullptr) {
    gather_rays(gathering.light, gathering.net, point, seed, gathering.form_factors, work.gather);
  } else {
    work.gather.result.clear();
    if (before->rays < double(gathering.net.points.size()))
      gather_rays(gathering.light, gathering.others, point, seed, gathering.form_factors,
                  work.gather);
    append(*before, work.gather.result);
  }
  work.rays += work.gather.result.traced;
}

PointLight indirect_light_at(const PointGathering& gathering, const Receiver& receiver,
                             std::uint32_t seed, PointWorkspace& work, const GatheredRays* before) {
  gather_rays_at(gathering, receiver, seed, before, work);

  work.indirect_by_lamp.assign(gathering.reflected_by_lamp.rows > 0 ? gathering.light.lamps.count : 0,
                               Rgb(0.0));
  PointLight light = landed_light(gathering, work.gather.result, work.indirect_by_lamp);
  light.from_clusters = cluster_irradiance(
      {gathering.secondary_lighting, gathering.cluster_tree, gathering.secondary, gathering.cut}, receiver,
      hash(seed, 2), work.clusters, work.direct);
  if (gathering.lamps)
    for (std::size_t l = 0; l < work.indirect_by_lamp.size(); ++l)
      work.indirect_by_lamp[l] += work.direct.by_lamp[l];
  return light;
}

PointLight light_at(const PointGathering& gathering, const Receiver& receiver, std::uint32_t seed,
                    PointWorkspace& work) {
  PointLight light = indirect_light_at(gathering, receiver, seed, work);
  light.direct =
      direct_irradiance(gathering.light, receiver, gathering.direct, hash(seed, 1), work.direct);
  work.direct_by_lamp = work.direct.by_lamp;
  return light;
}

/// A point of an element.
static Receiver point_of(const ElementMesh& mesh, const SurfaceModel& surfaces, ElementId element,
                         const glm::vec2& st) {
  const MeshCell& cell = cell_of(mesh, element);
  const MeshSide& side = mesh.sides[index(cell.side)];
  const Patch& patch = surfaces.patches[index(side.patch)];
  return {point_at(patch, patch_uv_of(mesh, cell, Vec2(st))), side.normal, side.plane_class,
          side.tangent, side.coat};
}

/// The light that comes through at a place of an element of a translucent surface.
static Rgb told_from_behind(const PointGathering& gathering, std::uint32_t element,
                            const glm::vec2& place, std::uint32_t seed, PointWorkspace& work) {
  const ElementMesh& mesh = gathering.light.mesh;
  const SideId behind = side_behind(mesh, mesh.side_of_element[element]);
  if (behind == none<SideId>)
    return Rgb(0.0);
  const MeshSide& side = mesh.sides[index(behind)];
  const Patch& patch = gathering.light.surfaces.patches[index(side.patch)];
  const Receiver point{
      point_at(patch, patch_uv_of(mesh, cell_of(mesh, ElementId{element}), Vec2(place))),
      side.normal, side.plane_class, side.tangent, side.coat};
  return mesh.transmittance[element] * light_at(gathering, point, seed, work).all().total;
}

ArrivingLight one_more_bounce(const PointGathering& gathering, const Receiver& receiver, int places,
                              std::uint32_t seed, PointWorkspace& work) {
  GatherWorkspace& rays = work.gather;
  rays.keeps_places = true;
  gather_rays(gathering.light, gathering.net, area_of(receiver), seed, gathering.form_factors,
              rays);
  rays.keeps_places = false;
  work.rays += rays.result.traced;
  const Rgb kept = kept_light(rays.result);
  const std::size_t landed = rays.result.landings.size(),
                    some = std::min(landed, static_cast<std::size_t>(places));
  // Landings stand in the order of directions: every so many-th are spread over the hemisphere.
  std::vector<std::pair<ElementHit, glm::vec2>> chosen;
  for (std::uint32_t k = 0; k < some; ++k) {
    const double within = 0x1p-32 * hash(seed, 0xb0ce, k);
    const auto at = static_cast<std::size_t>((k + within) * double(landed) / double(some));
    chosen.emplace_back(rays.result.landings[at], rays.places[at]);
  }
  const ElementMesh& mesh = gathering.light.mesh;
  ArrivingLight change;
  for (std::uint32_t k = 0; k < some; ++k) {
    const auto& [landing, place] = chosen[k];
    const Receiver point =
        point_of(mesh, gathering.light.surfaces, ElementId{landing.element}, place);
    const Rgb gathered = light_at(gathering, point, hash(seed, 0xb0cf, k), work).all().total;
    const Rgb told =
        mesh.reflectance[landing.element] * gathered +
        told_from_behind(gathering, landing.element, place, hash(seed, 0xb0d0, k), work);
    const Rgb more = Rgb(landing.light) / kept * (told - gathering.reflected[landing.element]) *
                     (double(landed) / double(some));
    change.total += more;
    if (landing.world != real_world && landing.world != through_solids)
      change.mirrored += more;
  }
  return change;
}

} // namespace meninas
