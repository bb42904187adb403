#include "radiosity/queries/node_tally.h"

#include <algorithm>

namespace meninas {

void add(const NodeScene& scene, const GatheredRays& gathered, double share, NodeTally& tally) {
  tally.totals.resize(scene.group_count, 0.0);
  const double weight = share / gathered.rays;
  tally.cut += weight * mean_of(Rgb(gathered.cut_light));
  for (const ElementHit& landing : gathered.landings) {
    const std::uint32_t group = scene.groups[index(scene.mesh.side_of_element[landing.element])];
    if (group == none_of_sets)
      continue;
    const double arrived = weight * mean_of(Rgb(landing.light));
    tally.by_world[{group, index(landing.world)}] += arrived;
    tally.totals[group] += arrived;
  }
}

void add(const NodeTally& part, NodeTally& tally) {
  tally.totals.resize(std::max(tally.totals.size(), part.totals.size()), 0.0);
  for (std::size_t g = 0; g < part.totals.size(); ++g)
    tally.totals[g] += part.totals[g];
  for (const auto& [key, value] : part.by_world)
    tally.by_world[key] += value;
  tally.cut += part.cut;
}

std::vector<ExtendedFactor> node_factors_of(const NodeScene& scene,
                                            std::span<const NodeTally> tallies,
                                            const Combine& combine) {
  std::vector<ExtendedFactor> factors(scene.group_count);
  double cut = 0.0;
  for (const NodeTally& tally : tallies)
    cut += tally.cut / static_cast<double>(tallies.size());
  // Light beyond the wanted depth is not asked for;
  // only light that has grown too faint on the way is missing then.
  if (scene.settings.max_bounces < FormFactorSettings{}.max_bounces)
    cut = std::min(cut, scene.settings.min_throughput);
  for (std::size_t g = 0; g < factors.size(); ++g) {
    std::vector<double> totals;
    for (const NodeTally& tally : tallies)
      totals.push_back(tally.totals[g]);
    factors[g].total = combine(totals);
    factors[g].total.error += cut;
  }

  std::map<NodeTally::Key, std::vector<double>> by_world;
  for (std::size_t k = 0; k < tallies.size(); ++k)
    for (const auto& [key, value] : tallies[k].by_world) {
      auto& values = by_world[key];
      values.resize(tallies.size(), 0.0);
      values[k] = value;
    }
  for (const auto& [key, values] : by_world) {
    // Worlds beyond the enumerated ones, and what is behind solids, have no chain to be told by:
    // they are in the total alone.
    const auto world = static_cast<WorldId>(key.second);
    if (world == none<WorldId> || is_by_solids(world))
      continue;
    const Rgb& throughput = scene.worlds.worlds[key.second].throughput;
    factors[key.first].worlds.push_back(
        {chain_of(scene.worlds, world), throughput, (1.0 / mean_of(throughput)) * combine(values)});
  }
  for (auto& factor : factors)
    std::stable_sort(
        factor.worlds.begin(), factor.worlds.end(), [](const WorldFactor& a, const WorldFactor& b) {
          return mean_of(a.throughput) * a.factor.value > mean_of(b.throughput) * b.factor.value;
        });
  return factors;
}

} // namespace meninas
