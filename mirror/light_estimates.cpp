#include "mirror/light_estimates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double small_for_distance = 0.2; ///< radius over distance of a node seen from afar

/// The largest cosine any emitter of the node can have towards x: the angle to the axis,
/// less the spread of the normals and the angle at which x sees the sphere.
double emitting_cosine(const EmitterNode& node, double radius, double cos_axis, double distance) {
  if (node.cos_spread <= -1.0)
    return 1.0;
  // Angles of at most pi, as cosines and sines: nothing is left of them once it is subtracted.
  const auto sine = [](double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); };
  const double cos_angle = std::clamp(cos_axis, -1.0, 1.0), cos_spread = node.cos_spread;
  if (cos_angle >= cos_spread)
    return 1.0;
  const double cos_beyond = cos_angle * cos_spread + sine(cos_angle) * sine(cos_spread);
  const double sin_sphere = std::min(1.0, radius / distance), cos_sphere = sine(sin_sphere);
  if (cos_beyond >= cos_sphere)
    return 1.0;
  return std::max(0.0, cos_beyond * cos_sphere + sine(cos_beyond) * sin_sphere);
}

} // namespace

void find_views(const WorldTree& worlds, const SeenWorlds& seen, const Observer& observer,
                std::vector<LampView>& views) {
  views.clear();
  for (const SeenWorld& in : seen.worlds) {
    const MirrorWorld& world = worlds.worlds[index(in.world)];
    // The inverse of an isometry: v * linear is the transposed times v.
    const Rgb& tau = world.throughput;
    views.push_back({in, (observer.position - world.image.translation) * world.image.linear,
                     observer.normal * world.image.linear, std::max({tau.r, tau.g, tau.b})});
  }
}

/// Where a sphere lies around x + to, `to` in the lamps' own space.
Where LightEstimates::through_window(const LampView& from, const Vec3& to, double radius) const {
  const MirrorWorld& world = worlds.worlds[index(from.seen.world)];
  return world.depth == 0 ? Where::inside
                          : where_in_window(cones, world, from.seen, observer.position,
                                            apply_direction(world.image, to), radius);
}

bool LightEstimates::is_small(const LampView& from, std::uint32_t at_node) const {
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = node.centre - from.position;
  const double least = node.radius / small_for_distance + extent;
  return glm::dot(to, to) >= least * least;
}

bool LightEstimates::is_wholly_seen(const LampView& from, std::uint32_t at_node) const {
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = node.centre - from.position;
  const double radius = node.radius + extent;
  return where(glm::dot(to, from.normal), radius) == Where::inside &&
         through_window(from, to, radius) == Where::inside;
}

double LightEstimates::light_from_afar(const LampView& from, std::uint32_t at_node) const {
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = node.middle - from.position;
  const double distance = glm::length(to);
  return from.throughput * intensity_times_pi(tree, node, -to / distance) *
         std::max(0.0, glm::dot(to, from.normal)) /
         (std::numbers::pi * distance * distance * distance);
}

double LightEstimates::estimate(const LampView& from, std::uint32_t at_node) const {
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = node.centre - from.position;
  const double radius = node.radius + extent;
  const double height = glm::dot(to, from.normal) + radius;
  if (height <= 0.0)
    return 0.0;
  const double distance = glm::length(to);
  double cosines = 1.0;
  const double cos_axis = -glm::dot(node.axis, to) / distance;
  if (node.second_child == 0 && cos_axis <= 0.0 && extent == 0.0)
    return 0.0;
  if (distance > radius) {
    cosines = std::min(1.0, height / distance) * emitting_cosine(node, radius, cos_axis, distance);
    if (cosines <= 0.0 || through_window(from, to, radius) == Where::outside)
      return 0.0;
  }
  const double reach = std::max(distance, node.radius);
  return from.throughput * node.power * cosines / (std::numbers::pi * reach * reach);
}

} // namespace meninas
