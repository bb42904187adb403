#include "radiosity/gather_rays.h"
#include "radiosity/node_form_factors.h"
#include "scenes/errors.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas {

namespace {

constexpr std::uint32_t replicas = 16;

/// A triangle of A and its part of A's area.
struct Sender {
  ReceiverArea area;
  double share = 0.0;
  int rays = 0; ///< in each replica
};

std::vector<Sender> senders_of(const std::vector<Face>& faces, int rays) {
  double total = 0.0;
  for (const Face& face : faces)
    total += face.area;
  std::vector<Sender> senders;
  for (const Face& face : faces)
    for (std::size_t k = 2; k < face.polygon.size; ++k) {
      Sender sender;
      sender.area.corner = face.polygon.vertices[0];
      sender.area.edge_u = face.polygon.vertices[k - 1] - sender.area.corner;
      sender.area.edge_v = face.polygon.vertices[k] - sender.area.corner;
      sender.area.triangle = true;
      sender.area.normal = face.plane.normal;
      sender.area.plane_class = face.plane_class;
      sender.share = 0.5 * glm::length(glm::cross(sender.area.edge_u, sender.area.edge_v)) / total;
      sender.rays = std::max(1, static_cast<int>(std::lround(sender.share * rays / replicas)));
      senders.push_back(sender);
    }
  return senders;
}

/// By SideId: the place of its node among those asked for, fronts only.
constexpr std::uint32_t not_asked = 0xffffffffU;
std::vector<std::uint32_t> groups_of_sides(const Scene& scene, const ElementMesh& mesh,
                                           std::span<const NodeId> to) {
  std::vector<std::uint32_t> groups(mesh.sides.size(), not_asked);
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const std::string& name = scene.nodes[index(mesh.sides[s].node)].name;
    const auto place = std::find_if(
        to.begin(), to.end(), [&](NodeId node) { return scene.nodes[index(node)].name == name; });
    if (place != to.end() && mesh.sides[s].facing == Facing::front)
      groups[s] = static_cast<std::uint32_t>(place - to.begin());
  }
  return groups;
}

using Key = std::pair<std::uint32_t, std::uint32_t>; ///< group, world
struct Sum {
  double weighted = 0.0, geometric = 0.0; ///< with tau and without
};

struct Replica {
  std::map<Key, Sum> sums;
  std::vector<double> totals; ///< by group
  double cut = 0.0;
};

Replica run_replica(const LightScene& light, const std::vector<Sender>& senders,
                    const std::vector<std::uint32_t>& groups, std::size_t group_count,
                    const FormFactorSettings& settings, std::uint32_t seed) {
  Replica replica;
  replica.totals.assign(group_count, 0.0);
  GatherWorkspace work;
  std::map<int, DirectionNet> nets;
  for (std::uint32_t s = 0; s < senders.size(); ++s) {
    const Sender& sender = senders[s];
    DirectionNet& net = nets[sender.rays];
    if (net.points.empty())
      net = make_direction_net(sender.rays);
    gather_rays(light, net, sender.area, hash(seed, s, 0xf0f), settings, work);
    const double weight = sender.share / static_cast<double>(net.points.size());
    replica.cut += weight * mean_of(Rgb(work.result.cut_light));
    for (const RayLanding& landing : work.result.landings) {
      const std::uint32_t group = groups[index(light.mesh.side_of_element[landing.element])];
      if (group == not_asked)
        continue;
      const double tau = mean_of(Rgb(landing.throughput));
      Sum& sum = replica.sums[{group, index(landing.world)}];
      sum.weighted += weight * tau;
      sum.geometric += weight;
      replica.totals[group] += weight * tau;
    }
  }
  return replica;
}

/// The mean of the replicas and the standard error of that mean. That all replicas agree, because none of their rays was the odd one out,
/// is no proof: the share of one ray is the least error.
Estimate estimate_of(const std::vector<double>& values, double one_ray) {
  double mean = 0.0, squares = 0.0;
  for (const double value : values)
    mean += value / replicas;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  return {mean, std::hypot(std::sqrt(squares / (replicas * (replicas - 1.0))), one_ray)};
}

std::vector<ExtendedFactor> summarise(const LightScene& light, const std::vector<Replica>& runs,
                                      std::size_t group_count, const NodeFactorSettings& settings) {
  std::vector<ExtendedFactor> factors(group_count);
  const double one_ray = 1.0 / settings.rays;
  double cut = 0.0;
  for (const Replica& run : runs)
    cut += run.cut / replicas;
  // What lies beyond the depth asked for is not asked for; all that is missing then is what has grown too faint on the way.
  const FormFactorSettings standard;
  if (settings.max_depth < standard.max_bounces)
    cut = std::min(cut, standard.min_throughput);
  for (std::size_t g = 0; g < group_count; ++g) {
    std::vector<double> totals;
    for (const Replica& run : runs)
      totals.push_back(run.totals[g]);
    factors[g].total = estimate_of(totals, one_ray);
    factors[g].total.error += cut;
  }
  std::map<Key, std::vector<double>> by_world;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const auto& [key, sum] : runs[r].sums) {
      auto& values = by_world[key];
      values.resize(replicas, 0.0);
      values[r] = sum.geometric;
    }
  for (const auto& [key, values] : by_world) {
    // Worlds beyond the enumerated ones have no chain to be told by: they are in the total alone.
    const auto world = static_cast<WorldId>(key.second);
    if (world == none<WorldId>)
      continue;
    factors[key.first].worlds.push_back({chain_of(light.worlds, world),
                                         light.worlds.worlds[key.second].throughput,
                                         estimate_of(values, one_ray)});
  }
  for (auto& factor : factors)
    std::stable_sort(
        factor.worlds.begin(), factor.worlds.end(), [](const WorldFactor& a, const WorldFactor& b) {
          return mean_of(a.throughput) * a.factor.value > mean_of(b.throughput) * b.factor.value;
        });
  return factors;
}

void require_sides(const Scene& scene, std::span<const NodeId> to,
                   const std::vector<std::uint32_t>& groups) {
  for (std::uint32_t g = 0; g < to.size(); ++g)
    if (std::find(groups.begin(), groups.end(), g) == groups.end())
      throw UsageError(scene.file, "node '" + scene.nodes[index(to[g])].name +
                                       "' is a mirror: rays go on through it");
}

} // namespace

std::vector<ExtendedFactor> ray_form_factors(const Scene& scene, const SurfaceModel& surfaces,
                                             const MirrorSet& mirrors,
                                             const std::vector<Face>& from,
                                             std::span<const NodeId> to,
                                             const NodeFactorSettings& settings) {
  // One element for each patch is enough to know whose it is; a mirror's landing is known by its table.
  const ElementMesh mesh = make_element_mesh(scene, surfaces, {.target_elements = 1.0});
  const std::vector<std::uint32_t> groups = groups_of_sides(scene, mesh, to);
  require_sides(scene, to, groups);
  const RayScene rays = make_ray_scene(scene, surfaces);
  WorldSettings named;
  named.max_depth = std::min(named.max_depth, settings.max_depth);
  const WorldTree worlds = mirror_worlds(mirrors, named);
  const LightScene light = make_light_scene(scene, surfaces, rays, mirrors, worlds, mesh);
  const std::vector<Sender> senders = senders_of(from, settings.rays);
  FormFactorSettings ray_settings;
  ray_settings.max_bounces = std::min(ray_settings.max_bounces, settings.max_depth);

  std::vector<Replica> runs(replicas);
  tbb::parallel_for(std::uint32_t{0}, replicas, [&](std::uint32_t r) {
    runs[r] = run_replica(light, senders, groups, to.size(), ray_settings,
                          hash(settings.seed, r, 0x5e71));
  });
  return summarise(light, runs, to.size(), settings);
}

} // namespace meninas
