#include "mirror/worlds.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

double largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }

ConvexPolygon image_of(const Isometry& map, const ConvexPolygon& polygon) {
  ConvexPolygon image;
  for (const auto& vertex : polygon.span())
    image.push_back(apply(map, vertex));
  return image;
}

/// Some point of the window lies in front of the plane, by more than the rounding of their coordinates.
bool reaches_front(std::span<const ConvexPolygon> window, const Plane& plane) {
  constexpr double rounding = 1e-13;
  for (const auto& part : window)
    for (const auto& vertex : part.span())
      if (signed_distance(plane, vertex) >
          rounding * (glm::length(vertex) + std::abs(plane.offset)))
        return true;
  return false;
}

/// A segment on its way to the front of the child's plane crosses every window before it in front of that plane.
bool seen_through(const WorldTree& tree, WorldId parent, const Plane& plane) {
  for (WorldId w = parent; w != real_world; w = tree.worlds[index(w)].parent)
    if (!reaches_front(tree.worlds[index(w)].window, plane))
      return false;
  return true;
}

/// The mirror's window in the parent's world, without what lies on the observer's side of the parent's own mirror.
std::vector<ConvexPolygon> child_window(const MirrorWorld& parent, const Mirror& mirror) {
  std::vector<ConvexPolygon> window;
  for (const auto& part : mirror.window) {
    ConvexPolygon image = image_of(parent.image, part);
    if (parent.depth > 0)
      image = clip(image, parent.plane.offset * parent.plane.normal, -parent.plane.normal);
    if (!image.empty())
      window.push_back(image);
  }
  return window;
}

} // namespace

WorldTree mirror_worlds(const MirrorSet& mirrors, const WorldSettings& settings) {
  WorldTree tree;
  tree.worlds.emplace_back();
  const std::size_t mirror_count = mirrors.mirrors.size();

  // Breadth first, so that a limit on the number of worlds leaves out the deepest.
  for (std::size_t w = 0; w < tree.worlds.size(); ++w) {
    tree.children.emplace_back(mirror_count, none<WorldId>);
    for (std::size_t m = 0; m < mirror_count; ++m) {
      const MirrorWorld& parent = tree.worlds[w];
      const Mirror& mirror = mirrors.mirrors[m];
      if (parent.mirror == static_cast<MirrorId>(m))
        continue;
      ++tree.considered;

      const Rgb throughput = parent.throughput * mirror.reflectance;
      if (largest(throughput) < settings.min_throughput) {
        ++tree.pruned_throughput;
        continue;
      }
      const Plane plane = apply(parent.image, mirror.plane);
      auto window = child_window(parent, mirror);
      if (window.empty() || !seen_through(tree, static_cast<WorldId>(w), plane)) {
        ++tree.pruned_unseen;
        continue;
      }
      if (parent.depth >= settings.max_depth ||
          tree.worlds.size() > static_cast<std::size_t>(settings.max_worlds)) {
        ++tree.pruned_limit;
        continue;
      }
      MirrorWorld world{static_cast<WorldId>(w),
                        static_cast<MirrorId>(m),
                        parent.depth + 1,
                        throughput,
                        compose_reflection(parent.image, mirror.plane),
                        plane,
                        std::move(window)};
      tree.children[w][m] = static_cast<WorldId>(tree.worlds.size());
      tree.worlds.push_back(std::move(world));
    }
  }
  return tree;
}

std::vector<MirrorId> chain_of(const WorldTree& tree, WorldId world) {
  std::vector<MirrorId> chain;
  for (; world != real_world; world = tree.worlds[index(world)].parent)
    chain.push_back(tree.worlds[index(world)].mirror);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

} // namespace meninas
