#include "radiosity/queries/gltf_node_factors.h"
#include "radiosity/queries/node_tally.h"
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

NodeTally run_replica(const NodeScene& scene, const std::vector<Sender>& senders,
                      std::uint32_t seed) {
  NodeTally tally;
  GatherWorkspace work;
  std::map<int, HemisphereSamples> nets;
  for (std::uint32_t s = 0; s < senders.size(); ++s) {
    const Sender& sender = senders[s];
    HemisphereSamples& net = nets[sender.rays];
    if (net.points.empty())
      net = make_direction_net(sender.rays);
    gather_rays(scene.light, net, sender.area, hash(seed, s, 0xf0f), scene.settings, work);
    add(scene, work.result, sender.share, tally);
  }
  return tally;
}

/// The mean of the replicas and the standard error of that mean. That all replicas agree, because
/// none of their rays was the odd one out, is no proof: the share of one ray is the least error.
Estimate replica_estimate(std::span<const double> values, double one_ray) {
  double mean = 0.0, squares = 0.0;
  for (const double value : values)
    mean += value / replicas;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  return {mean, std::hypot(std::sqrt(squares / (replicas * (replicas - 1.0))), one_ray)};
}

} // namespace

std::vector<ExtendedFactor> ray_form_factors(const Scene& scene, const SurfaceModel& surfaces,
                                             const MirrorSet& mirrors,
                                             const std::vector<Face>& from,
                                             std::span<const NodeSet> to,
                                             const NodeFactorSettings& settings) {
  const NodeScene node_scene(scene, surfaces, mirrors, {to, settings.sides}, settings.max_depth);
  require_landings(node_scene, {to, settings.sides});
  const std::vector<Sender> senders = senders_of(from, settings.rays);
  std::vector<NodeTally> runs(replicas);
  tbb::parallel_for(std::uint32_t{0}, replicas, [&](std::uint32_t r) {
    runs[r] = run_replica(node_scene, senders, hash(settings.seed, r, 0x5e71));
  });
  const double one_ray = 1.0 / settings.rays;
  return node_factors_of(node_scene, runs, [one_ray](std::span<const double> values) {
    return replica_estimate(values, one_ray);
  });
}

} // namespace meninas
