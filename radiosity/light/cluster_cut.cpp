#include "radiosity/light/cluster_cut.h"

#include "radiosity/light/virtual_light_visibility.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// One plane of clusters in one world, as seen from x.
struct PlaneImage {
  const Lighting& light;
  const ClusterTree& tree;
  const Receiver& receiver;
  const SeenWorld& seen;
  const MirrorWorld& world;
  std::uint32_t plane;
  Direction normal; ///< of the image
  double theta;
};

/// Each channel from its own centre.
Rgb light_of(const PlaneImage& image, const ClusterNode& node) {
  Rgb light = image.world.throughput * node.power / std::numbers::pi;
  for (int band = 0; band < 3; ++band)
    light[band] *=
        form_factor_share(image.receiver, image.normal,
                          apply(image.world.image, node.centre[static_cast<std::size_t>(band)]));
  return light;
}

void cut_plane(const PlaneImage& image, const Observer& observer, ClusterWorkspace& work,
               std::vector<VirtualLight>& lights) {
  work.open.assign(1, image.tree.planes[image.plane].root);
  while (!work.open.empty()) {
    const std::uint32_t at = work.open.back();
    const ClusterNode& node = image.tree.nodes[at];
    work.open.pop_back();
    const Vec3 to = apply(image.world.image, node.middle) - observer.position;
    const Where above = where(glm::dot(to, observer.normal), node.radius);
    if (above == Where::outside)
      continue;
    const Where through = where_in_window(work.cones, image.world, image.seen,
                                          observer.position, to, node.radius);
    if (through == Where::outside)
      continue;
    const bool small = node.radius * node.radius <= image.theta * image.theta * glm::dot(to, to);
    if (small && above == Where::inside && through == Where::inside) {
      const Rgb light = light_of(image, node);
      if (largest(light) > 0.0)
        work.stand_ins.push_back({at, image.plane, image.seen.world, light});
    } else if (node.second_child == 0) {
      add_images({image.light.worlds, work.seen, image.seen, observer}, image.light.emitters,
                 image.tree.order[node.first], 1.0, lights);
    } else {
      work.open.push_back(node.second_child);
      work.open.push_back(at + 1);
    }
  }
}

/// Shares `rays` out among the stand-ins by what each would bring,
/// beside what has arrived from the clusters nearby; at most `per_cluster` for each of theirs.
void share_rays(int rays, int per_cluster, const Rgb& arrived, const Lighting& light,
                const ClusterTree& tree, ClusterWorkspace& work) {
  double all = largest(arrived);
  for (const LightcutNode& part : work.stand_ins)
    all += largest(part.light);
  work.rays.clear();
  for (std::uint32_t k = 0; k < work.stand_ins.size(); ++k) {
    const LightcutNode& part = work.stand_ins[k];
    const double own = std::min(rays * (largest(part.light) / all),
                                static_cast<double>(per_cluster) * tree.nodes[part.node].count);
    const auto count = static_cast<std::uint32_t>(std::max(1L, std::lround(own)));
    for (std::uint32_t number = 0; number < count; ++number)
      work.rays.push_back({k, number});
  }
  // Rays of as many legs go together.
  std::ranges::stable_sort(work.rays, {}, [&](const auto& ray) {
    return light.worlds.worlds[index(work.stand_ins[ray.stand_in].world)].depth;
  });
}

SegmentEnd end_of(const ClusterPlane& plane) { return {plane.plane.normal, plane.coat}; }

/// Traces sixteen rays at a time.
void trace_rays(const Lighting& light, const ClusterTree& tree, const Receiver& receiver,
                std::uint32_t seed, ClusterWorkspace& work, DirectWorkspace& direct) {
  work.arrived.assign(work.stand_ins.size(), Rgb(0.0));
  work.sent.assign(work.stand_ins.size(), Rgb(0.0));
  for (std::size_t first = 0; first < work.rays.size(); first += 16) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(16, work.rays.size() - first));
    std::array<Rgb, 16> weight;
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto [stand_in, number] = work.rays[first + k];
      const LightcutNode& part = work.stand_ins[stand_in];
      const ClusterPlane& plane = tree.planes[part.plane];
      const Isometry& image = light.worlds.worlds[index(part.world)].image;
      const Vec2 sample(sobol2(number, hash(seed, part.node, index(part.world)), SobolPair::first));
      const ClusterPoint point = point_on(tree, tree.nodes[part.node], sample);
      const Point3 y = apply(image, point.position);
      weight[k] =
          point.colour * form_factor_share(receiver, apply_direction(image, plane.plane.normal), y);
      fold(light.scene, part.world, {receiver.position, y, receiver.plane_class, plane.plane_class},
           direct.folded[k]);
    }
    const std::uint32_t dark = blocked(light.scene, direct.folded, count, direct.shadow_rays);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t stand_in = work.rays[first + k].stand_in;
      work.sent[stand_in] += weight[k];
      if (((dark >> k) & 1U) == 0U)
        work.arrived[stand_in] +=
            weight[k] * transmittance_between(light.scene, end_of(receiver),
                                     end_of(tree.planes[work.stand_ins[stand_in].plane]),
                                     direct.folded[k]);
    }
  }
}

/// By channel; channels in which none of the points sends take the share of the others.
Rgb visible_share(const Rgb& sent, const Rgb& arrived) {
  const double all = sent.r + sent.g + sent.b;
  if (!(all > 0.0))
    return Rgb(0.0);
  Rgb share((arrived.r + arrived.g + arrived.b) / all);
  for (int band = 0; band < 3; ++band)
    if (sent[band] > 0.0)
      share[band] = arrived[band] / sent[band];
  return share;
}

} // namespace

void cut_clusters(const Lighting& light, const ClusterTree& tree, const Receiver& receiver,
                  double theta, ClusterWorkspace& work, std::vector<VirtualLight>& lights) {
  lights.clear();
  work.stand_ins.clear();
  if (tree.planes.empty())
    return; // nor need there be any worlds
  const Observer observer{receiver.position, receiver.normal, light.scene.surfaces.tolerance};
  seen_worlds(light.worlds, observer, work.seen);
  find_cones(work.seen, observer.position, work.cones);
  for (const SeenWorld& seen : work.seen.worlds) {
    const MirrorWorld& world = light.worlds.worlds[index(seen.world)];
    for (std::uint32_t p = 0; p < tree.planes.size(); ++p) {
      const Plane plane = apply(world.image, tree.planes[p].plane);
      if (signed_distance(plane, observer.position) <= observer.tolerance)
        continue;
      cut_plane({light, tree, receiver, seen, world, p, plane.normal, theta}, observer, work,
                lights);
    }
  }
}

ArrivingLight cluster_irradiance(const ClusterLight& clusters, const Receiver& receiver,
                                 std::uint32_t seed, ClusterWorkspace& work,
                                 DirectWorkspace& direct) {
  const auto& [light, tree, settings, cut] = clusters;
  if (!(cut.theta > 0.0))
    return direct_irradiance(light, receiver, settings, seed, direct);
  cut_clusters(light, tree, receiver, cut.theta, work, direct.lights);
  ArrivingLight sum = images_irradiance(light, receiver, settings, seed, direct);
  if (work.stand_ins.empty())
    return sum;
  share_rays(cut.rays, settings.shadow_rays, sum.total, light, tree, work);
  trace_rays(light, tree, receiver, seed, work, direct);
  for (std::size_t k = 0; k < work.stand_ins.size(); ++k) {
    const LightcutNode& part = work.stand_ins[k];
    const Rgb arrived = part.light * visible_share(work.sent[k], work.arrived[k]);
    sum.total += arrived;
    if (light.lamps)
      add_shares(light.lamps->of_node, part.node, arrived, direct.by_lamp);
    if (part.world != real_world)
      sum.mirrored += arrived;
  }
  return sum;
}

} // namespace meninas
