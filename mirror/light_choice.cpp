#include "mirror/light_choice.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  LightEstimates estimates{worlds, tree, observer, work.cones};

  const LampView& view(std::uint32_t world) const { return work.views[world]; }
  double estimate(std::uint32_t world, std::uint32_t node) const {
    return estimates.estimate(view(world), node);
  }
  bool is_leaf(std::uint32_t node) const { return tree.nodes[node].second_child == 0; }
  std::array<std::uint32_t, 2> children(std::uint32_t node) const {
    return {node + 1, tree.nodes[node].second_child};
  }

  static bool by_place(const CutNode& a, const CutNode& b) {
    return std::pair(a.world, a.node) < std::pair(b.world, b.node);
  }

  static bool is_darker(const CutNode& a, const CutNode& b) { return a.estimate < b.estimate; }

  /// Opens the brightest node of `work.open` again and again, until there are `2 most` or only emitters
  /// are left, and nodes seen from afar. Nodes that bring far less than the mean of these stay closed.
  void refine(const LightChoice& choice) {
    constexpr double far_less = 0.25;
    auto& open = work.open;
    auto& cut = work.cut;
    double sum = 0.0;
    for (const auto* nodes : {&open, &cut, &work.afar})
      for (const CutNode& node : *nodes)
        sum += node.estimate;
    while (!open.empty() && open.size() + cut.size() < 2 * choice.most) {
      const std::size_t nodes = open.size() + cut.size() + work.afar.size();
      if (!work.afar.empty() &&
          open.front().estimate * static_cast<double>(nodes) < far_less * sum)
        break;
      std::pop_heap(open.begin(), open.end(), is_darker);
      const CutNode top = open.back();
      open.pop_back();
      sum -= top.estimate;
      for (const auto child : children(top.node))
        sum += add(top.world, child, choice.afar > 0);
    }
  }

  /// Puts a node where it belongs; returns its estimate.
  double add(std::uint32_t world, std::uint32_t node, bool from_afar) {
    if (from_afar && !is_leaf(node) && estimates.is_small(view(world), node) &&
        estimates.is_wholly_seen(view(world), node))
      return add_afar(world, node);
    const CutNode next{estimate(world, node), world, node};
    if (next.estimate <= 0.0)
      return 0.0;
    if (is_leaf(node)) {
      work.cut.push_back(next);
    } else {
      work.open.push_back(next);
      std::push_heap(work.open.begin(), work.open.end(), is_darker);
    }
    return next.estimate;
  }

  double add_afar(std::uint32_t world, std::uint32_t node) {
    const double brought = estimates.light_from_afar(view(world), node);
    if (brought > 0.0 || estimates.extent > 0.0)
      work.afar.push_back({brought, world, node});
    return brought;
  }

  /// The cut from the roots of all worlds.
  void cut_anew(const LightChoice& choice) {
    for (std::uint32_t w = 0; w < work.seen.worlds.size(); ++w)
      add(w, 0, choice.afar > 0);
    refine(choice);
  }

  /// Finds the cut for all points of an area.
  void find_area_cut(const LightChoice& choice) {
    estimates.extent = choice.extent;
    cut_anew(choice);
    estimates.extent = 0.0;
    work.area = choice.area;
    work.of_area.clear();
    work.worlds_of_area.clear();
    for (const SeenWorld& seen : work.seen.worlds)
      work.worlds_of_area.push_back(seen.world);
    std::ranges::sort(work.worlds_of_area);
    const auto keep = [&](std::span<const CutNode> nodes, bool small) {
      for (const CutNode& node : nodes)
        work.of_area.push_back({work.seen.worlds[node.world].world, node.node, small});
    };
    keep(work.open, false);
    keep(work.cut, false);
    keep(work.afar, true);
    std::ranges::sort(work.of_area, {},
                      [](const auto& node) { return std::pair(node.world, node.node); });
    work.open.clear();
    work.cut.clear();
    work.afar.clear();
  }

  /// The estimates at x of the nodes of the area's cut, and of worlds that its first point did not see.
  void cut_of_area(const LightChoice& choice) {
    if (work.area != choice.area)
      find_area_cut(choice);
    for (std::uint32_t w = 0; w < work.seen.worlds.size(); ++w) {
      const SeenWorld& seen = work.seen.worlds[w];
      if (!std::ranges::binary_search(work.worlds_of_area, seen.world)) {
        add(w, 0, true);
        continue;
      }
      const auto nodes = std::ranges::equal_range(work.of_area, seen.world, {},
                                                  &LightChoiceWorkspace::AreaNode::world);
      for (const auto& at : nodes) {
        if (at.small && estimates.is_wholly_seen(view(w), at.node)) {
          add_afar(w, at.node);
          continue;
        }
        const CutNode next{estimate(w, at.node), w, at.node};
        if (next.estimate > 0.0)
          work.cut.push_back(next);
      }
    }
    refine(choice);
  }

  /// The cut at x: in `work.cut` what is chosen from, in `work.afar` what is seen from afar.
  void find_cut(const LightChoice& choice) {
    auto& cut = work.cut;
    work.open.clear();
    cut.clear();
    work.afar.clear();
    if (choice.area > 0 && choice.afar > 0)
      cut_of_area(choice);
    else
      cut_anew(choice);
    cut.insert(cut.end(), work.open.begin(), work.open.end());

    // In the order of the tree, neighbours take even steps together.
    std::sort(cut.begin(), cut.end(), by_place);
    std::sort(work.afar.begin(), work.afar.end(), by_place);
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

  /// By its place in the order of the tree, where its normal lies beside those of the others.
  bool faces(std::size_t place, const Point3& x) const {
    return glm::dot(tree.flux[place], x - emitters[tree.order[place]].corners[0]) > 0.0;
  }

  /// One of a node's emitters, by power times the cosine towards x from the node's middle; of those that
  /// face x any where some tries do not tell. `x` in the lamp's own space.
  std::uint32_t emitter_of(const EmitterNode& node, const Point3& x, std::uint32_t seed) const {
    constexpr std::uint32_t tries = 16;
    constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
    const double* const begin = tree.sent.data() + node.first;
    const Direction towards = glm::normalize(x - node.middle);
    std::size_t facing = nobody, place = 0;
    for (std::uint32_t k = 0; k < tries; ++k) {
      const double at = glm::mix(begin[0], begin[node.count], 0x1p-32 * hash(seed, 2 * k));
      place = static_cast<std::size_t>(std::upper_bound(begin + 1, begin + node.count, at) -
                                       tree.sent.data() - 1);
      const Vec3& flux = tree.flux[place];
      const double cosine = glm::dot(flux, towards); // times the length of flux
      const double least = 0x1p-32 * hash(seed, 2 * k + 1);
      const bool is_chosen = cosine > 0.0 && least * least * glm::dot(flux, flux) < cosine * cosine;
      if (!is_chosen && (cosine <= 0.0 || facing != nobody))
        continue;
      if (!faces(place, x))
        continue;
      if (is_chosen)
        return tree.order[place];
      facing = place;
    }
    return tree.order[facing != nobody ? facing : place];
  }

  /// Emitters that stand for the nodes seen from afar, at even steps along what these bring:
  /// `choice.afar` where they bring all of the light.
  void take_afar(const LightChoice& choice, double afar, double all) {
    const double step = afar / std::ceil(static_cast<double>(choice.afar) * (afar / all));
    const auto seed = static_cast<std::uint32_t>(0x1p32 * choice.offset);
    double sum = 0.0, next = choice.offset * step;
    for (const CutNode& at : work.afar) {
      sum += at.estimate;
      for (; next < sum; next += step)
        stand_for(at, step,
                  hash(seed, at.node, at.world * 4096 + static_cast<std::uint32_t>(next / step)));
    }
  }

  /// One of the node's emitters as an image that brings that much.
  void stand_for(const CutNode& at, double brought, std::uint32_t seed) {
    const EmitterNode& node = tree.nodes[at.node];
    const LampView& from = view(at.world);
    const std::uint32_t e = emitter_of(node, from.position, seed);
    const Rgb& radiosity = emitters[e].radiosity;
    add_whole_image(worlds, emitters, from.seen.world, e, lights);
    lights.back().afar =
        brought / (from.throughput * std::max({radiosity.r, radiosity.g, radiosity.b}));
  }

  /// The number of images to compute among those that are not seen from afar.
  double budget_of(const LightChoice& choice, double all, double rest) const {
    if (work.afar.empty())
      return static_cast<double>(choice.most);
    const auto leaves = std::ranges::count_if(
        work.cut, [&](const CutNode& node) { return is_leaf(node.node); });
    const double worth =
        rest / all * static_cast<double>(choice.afar) + 0.5 * static_cast<double>(leaves);
    return std::clamp(std::ceil(worth), 1.0, static_cast<double>(choice.most));
  }

  void choose(const LightChoice& choice) {
    if (!choice.same_point)
      find_cut(choice);
    auto& cut = work.chosen_from;
    cut = work.cut;
    double sum = 0.0, afar = 0.0;
    for (const auto& node : cut)
      sum += node.estimate;
    for (const auto& node : work.afar)
      afar += node.estimate;
    if (afar > 0.0)
      take_afar(choice, afar, sum + afar);

    // Emitters that a step would meet for certain are computed;
    // what is left of the budget goes to the others.
    double budget = budget_of(choice, sum + afar, sum);
    for (bool changed = true; changed && budget > 0.0;) {
      changed = false;
      const double sum_before = sum, budget_before = budget;
      for (auto& node : cut) {
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
    for (const auto& node : cut) {
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
  if (!choice.same_point)
    seen_worlds(worlds, observer, work.seen);
  if (emitters.size() * work.seen.worlds.size() <= choice.most) {
    all_lights(worlds, emitters, work.seen, observer, lights);
    return;
  }
  if (!choice.same_point) {
    find_cones(work.seen, observer.position, work.cones);
    find_views(worlds, work.seen, observer, work.views);
  }
  Chooser{worlds, emitters, tree, observer, work, lights}.choose(choice);
}

} // namespace meninas
