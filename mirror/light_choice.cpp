#include "mirror/light_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

using CutNode = LightChoiceWorkspace::CutNode;

struct Chooser {
  const WorldTree& worlds;
  std::span<const Emitter> emitters;
  const LightTree& tree;
  const Observer& observer;
  LightChoiceWorkspace& work;
  std::vector<VirtualLight>& lights;

  /// Whether a sphere of unfolded space is hidden from x:
  /// outside the cones through all openings, or before the last mirror.
  bool is_outside(const SeenWorld& seen, const Point3& centre, double radius) const {
    const MirrorWorld& world = worlds.worlds[index(seen.world)];
    if (world.depth == 0)
      return false;
    if (signed_distance(world.plane, centre) > radius)
      return true;
    for (std::uint32_t k = seen.first; k < seen.last; ++k)
      if (!is_outside_cone(work.seen.openings[k], centre, radius))
        return false;
    return true;
  }

  bool is_outside_cone(const ConvexPolygon& opening, const Point3& centre, double radius) const {
    const double side =
        glm::dot(area_vector(opening.span()), opening.vertices[0] - observer.position);
    Vec3 from = opening.vertices[opening.size - 1] - observer.position;
    for (std::size_t k = 0; k < opening.size; ++k) {
      const Vec3 to = opening.vertices[k] - observer.position;
      const Vec3 inward = side > 0.0 ? glm::cross(from, to) : glm::cross(to, from);
      from = to;
      const double distance = glm::dot(inward, centre - observer.position);
      if (distance < 0.0 && distance * distance > radius * radius * glm::dot(inward, inward))
        return true;
    }
    return false;
  }

  /// s: the power of the node, spread over what a sphere of its distance sees of it,
  /// with cosines no smaller than any emitter of it has. 0 only if none of its light arrives.
  double estimate(std::uint32_t at_world, std::uint32_t at_node) const {
    const SeenWorld& seen = work.seen.worlds[at_world];
    const MirrorWorld& world = worlds.worlds[index(seen.world)];
    const EmitterNode& node = tree.nodes[at_node];
    const Vec3 to = apply(world.image, node.centre) - observer.position;
    const double height = glm::dot(to, observer.normal) + node.radius;
    if (height <= 0.0)
      return 0.0;
    const double distance = glm::length(to);
    double cosines = 1.0;
    const double cos_axis = -glm::dot(apply_direction(world.image, node.axis), to) / distance;
    if (is_leaf(at_node) && cos_axis <= 0.0)
      return 0.0;
    if (distance > node.radius) {
      cosines = std::min(1.0, height / distance) * emitting_cosine(node, cos_axis, distance);
      if (cosines <= 0.0 || is_outside(seen, observer.position + to, node.radius))
        return 0.0;
    }
    const double reach = std::max(distance, node.radius);
    const Rgb& tau = world.throughput;
    return std::max({tau.r, tau.g, tau.b}) * node.power * cosines /
           (std::numbers::pi * reach * reach);
  }

  /// The largest cosine any emitter of the node can have towards x: the angle to the axis,
  /// less the spread of the normals and the angle at which x sees the sphere.
  static double emitting_cosine(const EmitterNode& node, double cos_axis, double distance) {
    if (node.cos_spread <= -1.0)
      return 1.0;
    // Angles of at most pi, as cosines and sines: nothing is left of them once it is subtracted.
    const auto sine = [](double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); };
    const double cos_angle = std::clamp(cos_axis, -1.0, 1.0), cos_spread = node.cos_spread;
    if (cos_angle >= cos_spread)
      return 1.0;
    const double cos_beyond = cos_angle * cos_spread + sine(cos_angle) * sine(cos_spread);
    const double sin_sphere = std::min(1.0, node.radius / distance), cos_sphere = sine(sin_sphere);
    if (cos_beyond >= cos_sphere)
      return 1.0;
    return std::max(0.0, cos_beyond * cos_sphere + sine(cos_beyond) * sin_sphere);
  }

  bool is_leaf(std::uint32_t node) const { return tree.nodes[node].second_child == 0; }
  std::array<std::uint32_t, 2> children(std::uint32_t node) const {
    return {node + 1, tree.nodes[node].second_child};
  }

  /// Opens the brightest node again and again, until there are `most` or only emitters are left.
  void refine(std::size_t most) {
    const auto darker = [](const CutNode& a, const CutNode& b) { return a.estimate < b.estimate; };
    auto& open = work.open;
    auto& cut = work.cut;
    open.clear();
    cut.clear();
    const auto add = [&](std::uint32_t world, std::uint32_t node) {
      const CutNode next{estimate(world, node), world, node};
      if (next.estimate <= 0.0)
        return;
      if (is_leaf(node)) {
        cut.push_back(next);
        return;
      }
      open.push_back(next);
      std::push_heap(open.begin(), open.end(), darker);
    };
    for (std::uint32_t w = 0; w < work.seen.worlds.size(); ++w)
      add(w, 0);
    while (!open.empty() && open.size() + cut.size() < most) {
      std::pop_heap(open.begin(), open.end(), darker);
      const CutNode top = open.back();
      open.pop_back();
      for (const auto child : children(top.node))
        add(top.world, child);
    }
    cut.insert(cut.end(), open.begin(), open.end());

    // In the order of the tree, neighbours take even steps together.
    std::sort(cut.begin(), cut.end(), [](const CutNode& a, const CutNode& b) {
      return std::pair(a.world, a.node) < std::pair(b.world, b.node);
    });
  }

  void take(std::uint32_t at_world, std::uint32_t leaf, double weight) {
    const std::uint32_t emitter = tree.order[tree.nodes[leaf].first];
    add_images({worlds, work.seen, work.seen.worlds[at_world], observer}, emitters, emitter, weight,
               lights);
  }

  /// Steps lie at the whole numbers;
  /// the node spans [begin, begin + q), its children their shares of that.
  void descend(std::uint32_t world, std::uint32_t node, double begin, double q) {
    if (is_leaf(node)) {
      if (q >= 1.0 || std::ceil(begin) < begin + q)
        take(world, node, std::max(1.0, 1.0 / q));
      return;
    }
    if (std::ceil(begin) >= begin + q)
      return;
    const auto [first, second] = children(node);
    const double a = estimate(world, first), b = estimate(world, second);
    if (a + b <= 0.0)
      return;
    const double share = q * (a / (a + b));
    if (a > 0.0)
      descend(world, first, begin, share);
    if (b > 0.0)
      descend(world, second, begin + share, q - share);
  }

  void choose(const LightChoice& choice) {
    refine(2 * choice.most);

    // Emitters that a step would meet for certain are computed;
    // what is left of the budget goes to the others.
    double budget = static_cast<double>(choice.most), sum = 0.0;
    for (const auto& node : work.cut)
      sum += node.estimate;
    for (bool changed = true; changed && budget > 0.0;) {
      changed = false;
      const double sum_before = sum, budget_before = budget;
      for (auto& node : work.cut) {
        if (node.estimate <= 0.0 || !is_leaf(node.node) ||
            node.estimate * budget_before < sum_before)
          continue;
        take(node.world, node.node, 1.0);
        sum -= node.estimate;
        budget -= 1.0;
        node.estimate = 0.0;
        changed = true;
      }
    }
    if (!(sum > 0.0))
      return;
    double begin = choice.offset;
    const double steps = std::max(1.0, budget) / sum;
    for (const auto& node : work.cut) {
      if (node.estimate <= 0.0)
        continue;
      const double q = steps * node.estimate;
      descend(node.world, node.node, begin, q);
      begin += q;
    }
  }
};

} // namespace

void sample_light_tree(const EmitterChoice& of, const Observer& observer, const LightChoice& choice,
                       LightChoiceWorkspace& work, std::vector<VirtualLight>& lights) {
  const auto& [worlds, emitters, tree] = of;
  lights.clear();
  if (emitters.empty())
    return;
  seen_worlds(worlds, observer, work.seen);
  if (emitters.size() * work.seen.worlds.size() <= choice.most) {
    all_lights(worlds, emitters, work.seen, observer, lights);
    return;
  }
  Chooser{worlds, emitters, tree, observer, work, lights}.choose(choice);
}

} // namespace meninas
