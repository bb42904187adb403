#include "mirror/worlds.h"

#include <algorithm>

namespace meninas {

namespace {

double largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }

ConvexPolygon image_of(const Isometry& map, const ConvexPolygon& polygon) {
  ConvexPolygon image;
  for (const auto& vertex : polygon.span()) image.push_back(apply(map, vertex));
  return image;
}

/// Some point of the parent's window can see the front of the child's plane; the real room always may.
bool seen_from_parent(const MirrorWorld& parent, const Plane& plane) {
  if (parent.window.empty()) return true;
  for (const auto& part : parent.window)
    for (const auto& vertex : part.span())
      if (signed_distance(plane, vertex) > 0.0) return true;
  return false;
}

/// The mirror's window in the parent's world, without what lies on the observer's side of the parent's own mirror.
std::vector<ConvexPolygon> child_window(const MirrorWorld& parent, const Mirror& mirror) {
  std::vector<ConvexPolygon> window;
  for (const auto& part : mirror.window) {
    ConvexPolygon image = image_of(parent.image, part);
    if (parent.depth > 0) image = clip(image, parent.plane.offset * parent.plane.normal, -parent.plane.normal);
    if (!image.empty()) window.push_back(image);
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
      if (parent.mirror == static_cast<MirrorId>(m)) continue;
      ++tree.considered;

      const Rgb throughput = parent.throughput * mirror.reflectance;
      if (largest(throughput) < settings.min_throughput) {
        ++tree.pruned_throughput;
        continue;
      }
      const Plane plane = apply(parent.image, mirror.plane);
      auto window = child_window(parent, mirror);
      if (window.empty() || !seen_from_parent(parent, plane)) {
        ++tree.pruned_unseen;
        continue;
      }
      if (parent.depth >= settings.max_depth || tree.worlds.size() > static_cast<std::size_t>(settings.max_worlds)) {
        ++tree.pruned_limit;
        continue;
      }
      MirrorWorld world{static_cast<WorldId>(w), static_cast<MirrorId>(m), parent.depth + 1, throughput,
                        compose_reflection(parent.image, mirror.plane), plane, std::move(window)};
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
