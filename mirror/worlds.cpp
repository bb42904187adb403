#include "mirror/worlds.h"

#include "mirror/antipenumbra.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The part of the window in front of the plane, by more than the rounding of their coordinates.
std::vector<ConvexPolygon> in_front(std::span<const ConvexPolygon> window, const Plane& plane) {
  constexpr double rounding = 1e-13;
  std::vector<ConvexPolygon> front;
  for (const auto& part : window) {
    double magnitude = std::abs(plane.offset), highest = 0.0;
    for (const auto& vertex : part.span()) {
      magnitude = std::max(magnitude, glm::length(vertex));
      highest = std::max(highest, signed_distance(plane, vertex));
    }
    if (highest > 2.0 * rounding * magnitude)
      front.push_back(clip(part, origin_of(plane), plane.normal));
  }
  std::erase_if(front, [](const ConvexPolygon& part) { return part.empty(); });
  return front;
}

/// The parts of windows that lines through the whole chain can meet, by world;
/// kept while the tree grows.
using OpenParts = std::vector<std::vector<ConvexPolygon>>;

/// The part that lines through some part of `first` and then some part of `second` meet.
/// Where several of them show it, it is not convex: then all of it is kept.
ConvexPolygon part_behind(const ConvexPolygon& part, std::span<const ConvexPolygon> first,
                          std::span<const ConvexPolygon> second) {
  ConvexPolygon seen;
  for (const auto& a : first)
    for (const auto& b : second) {
      const ConvexPolygon behind = clip_to_penumbra(part, a, b);
      if (behind.empty())
        continue;
      if (!seen.empty())
        return part;
      seen = behind;
    }
  return seen;
}

/// The parts of a child's window that lines can meet which have crossed all windows before it,
/// first one first.
std::vector<ConvexPolygon> open_parts(const WorldTree& tree, const OpenParts& open, WorldId parent,
                                      const Plane& plane,
                                      const std::vector<ConvexPolygon>& window) {
  if (parent == real_world)
    return window;

  // A line on its way to the front of the child's plane
  // crosses every window before it in front of that plane.
  std::vector<ConvexPolygon> parts = window;
  const auto second = in_front(open[index(parent)], plane);
  for (WorldId w = tree.worlds[index(parent)].parent; w != real_world;
       w = tree.worlds[index(w)].parent) {
    const auto first = in_front(in_front(open[index(w)], plane), tree.worlds[index(parent)].plane);
    for (auto& part : parts)
      part = part_behind(part, first, second);
    std::erase_if(parts, [](const ConvexPolygon& part) { return part.empty(); });
  }
  return second.empty() ? std::vector<ConvexPolygon>{} : parts;
}

} // namespace

std::vector<ConvexPolygon> window_in_world(const MirrorWorld& world, const Mirror& mirror) {
  std::vector<ConvexPolygon> window;
  for (const auto& part : mirror.window) {
    ConvexPolygon image = apply(world.image, part);
    if (world.depth > 0)
      image = clip(image, origin_of(world.plane), -world.plane.normal);
    if (!image.empty())
      window.push_back(image);
  }
  return window;
}

namespace {

struct TreeBuilder {
  const MirrorSet& mirrors;
  const WorldSettings& settings;
  WorldTree tree;
  OpenParts open;

  bool is_coat(std::size_t m) const { return mirrors.mirrors[m].is_coat; }
  bool has_coat(WorldId world) const {
    return std::ranges::any_of(chain_of(tree, world),
                               [&](MirrorId m) { return is_coat(index(m)); });
  }
  void add(MirrorWorld world, std::vector<ConvexPolygon> parts) {
    tree.worlds.push_back(std::move(world));
    tree.children.emplace_back(mirrors.mirrors.size(), none<WorldId>);
    open.push_back(std::move(parts));
  }
  void open_child(std::size_t w, std::size_t m, std::size_t most);
};

/// The world of mirror m in world w, unless it is unseen, faint or the tree has as many as it may.
void TreeBuilder::open_child(std::size_t w, std::size_t m, std::size_t most) {
  const MirrorWorld& parent = tree.worlds[w];
  const Mirror& mirror = mirrors.mirrors[m];
  // A line that has left a plane does not meet it again, nor its other side,
  // though windows that float rounds may be beyond it by a hair.
  if (parent.mirror != none<MirrorId> &&
      mirrors.mirrors[index(parent.mirror)].plane_class == mirror.plane_class)
    return;
  ++tree.considered;
  const Plane plane = apply(parent.image, mirror.plane);
  auto window = window_in_world(parent, mirror);
  auto parts = open_parts(tree, open, static_cast<WorldId>(w), plane, window);
  if (parts.empty()) {
    ++tree.pruned_unseen;
    return;
  }
  const Rgb throughput = parent.throughput * mirror.reflectance;
  const bool faint = largest(throughput) < settings.min_throughput;
  const bool beyond = parent.depth >= settings.max_depth || tree.worlds.size() > most;
  if (faint || beyond) {
    ++(faint ? tree.pruned_throughput : tree.pruned_limit);
    tree.cut.push_back({static_cast<WorldId>(w), static_cast<MirrorId>(m), throughput});
    return;
  }
  MirrorWorld world{static_cast<WorldId>(w),
                    static_cast<MirrorId>(m),
                    parent.depth + 1,
                    throughput,
                    compose_reflection(parent.image, mirror.plane),
                    plane,
                    std::move(window),
                    parent.chain};
  world.chain.push_back(world.mirror);
  tree.children[w][m] = static_cast<WorldId>(tree.worlds.size());
  add(std::move(world), std::move(parts));
}

} // namespace

WorldTree mirror_worlds(const MirrorSet& mirrors, const WorldSettings& settings) {
  TreeBuilder builder{mirrors, settings, {}, {}};
  builder.add({}, {});
  WorldTree& tree = builder.tree;
  const std::size_t mirror_count = mirrors.mirrors.size();

  // Breadth first, so that a limit on the number of worlds leaves out the deepest.
  auto most = static_cast<std::size_t>(settings.max_worlds);
  for (std::size_t w = 0; w < tree.worlds.size(); ++w)
    for (std::size_t m = 0; m < mirror_count; ++m)
      if (!builder.is_coat(m))
        builder.open_child(w, m, most);

  // Then those with a coat on their way, which bring less: they take no place from the others.
  most = tree.worlds.size() - 1 + static_cast<std::size_t>(settings.max_coat_worlds);
  for (std::size_t w = 0; w < tree.worlds.size(); ++w) {
    const bool is_new = builder.has_coat(static_cast<WorldId>(w));
    for (std::size_t m = 0; m < mirror_count; ++m)
      if (is_new || builder.is_coat(m))
        builder.open_child(w, m, most);
  }
  return std::move(builder.tree);
}

} // namespace meninas
