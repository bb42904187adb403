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

bool LightEstimates::is_small(const SeenWorld& in, std::uint32_t at_node) const {
  const EmitterNode& node = tree.nodes[at_node];
  const Point3 centre = apply(worlds.worlds[index(in.world)].image, node.centre);
  return node.radius <= small_for_distance * (glm::distance(centre, observer.position) - extent);
}

bool LightEstimates::is_wholly_seen(const SeenWorld& in, std::uint32_t at_node) const {
  const MirrorWorld& world = worlds.worlds[index(in.world)];
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = apply(world.image, node.centre) - observer.position;
  const double radius = node.radius + extent;
  return where(glm::dot(to, observer.normal), radius) == Where::inside &&
         where_in_window(cones, world, in, observer.position, to, radius) == Where::inside;
}

/// pi times the intensity towards x, W, of a node in one world.
double LightEstimates::intensity_towards(const MirrorWorld& world, const EmitterNode& node) const {
  const Vec3 to = apply(world.image, node.middle) - observer.position;
  // In the lamp's own space, of which the world's is an image.
  return intensity_times_pi(tree, node, -(to * world.image.linear) / glm::length(to));
}

double LightEstimates::light_from_afar(const SeenWorld& in, std::uint32_t at_node) const {
  const MirrorWorld& world = worlds.worlds[index(in.world)];
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = apply(world.image, node.middle) - observer.position;
  const double distance = glm::length(to);
  const Rgb& tau = world.throughput;
  return std::max({tau.r, tau.g, tau.b}) * intensity_towards(world, node) *
         std::max(0.0, glm::dot(to, observer.normal)) /
         (std::numbers::pi * distance * distance * distance);
}

double LightEstimates::estimate(const SeenWorld& in, std::uint32_t at_node) const {
  const MirrorWorld& world = worlds.worlds[index(in.world)];
  const EmitterNode& node = tree.nodes[at_node];
  const Vec3 to = apply(world.image, node.centre) - observer.position;
  const double radius = node.radius + extent;
  const double height = glm::dot(to, observer.normal) + radius;
  if (height <= 0.0)
    return 0.0;
  const double distance = glm::length(to);
  double cosines = 1.0;
  const double cos_axis = -glm::dot(apply_direction(world.image, node.axis), to) / distance;
  if (node.second_child == 0 && cos_axis <= 0.0 && extent == 0.0)
    return 0.0;
  if (distance > radius) {
    cosines = std::min(1.0, height / distance) * emitting_cosine(node, radius, cos_axis, distance);
    if (cosines <= 0.0 || where_in_window(cones, world, in, observer.position, to, radius) ==
                              Where::outside)
      return 0.0;
  }
  const double reach = std::max(distance, node.radius);
  const Rgb& tau = world.throughput;
  return std::max({tau.r, tau.g, tau.b}) * node.power * cosines /
         (std::numbers::pi * reach * reach);
}

} // namespace meninas
