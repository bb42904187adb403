#include "mirror/emitters.h"

#include "mirror/median_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas {

namespace {

Point3 centre_of(const ConvexPolygon& polygon) {
  Point3 sum(0.0);
  for (const auto& vertex : polygon.span())
    sum += vertex;
  return sum / static_cast<double>(std::max<std::size_t>(polygon.size, 1));
}

struct Builder {
  std::span<const Emitter> emitters;
  std::vector<Point3> centres; ///< by emitter
  LightTree tree;

  std::span<std::uint32_t> range(std::uint32_t first, std::uint32_t count) {
    return std::span(tree.order).subspan(first, count);
  }

  EmitterNode node_over(std::uint32_t first, std::uint32_t count) {
    EmitterNode node;
    node.first = first;
    node.count = count;
    Point3 low(std::numeric_limits<double>::infinity()), high = -low;
    Vec3 normals(0.0);
    for (const auto e : range(first, count)) {
      const Emitter& emitter = emitters[e];
      const Rgb& radiosity = emitter.radiosity;
      node.power += emitter.area * std::max({radiosity.r, radiosity.g, radiosity.b});
      normals += emitter.plane.normal;
      for (const auto& vertex : emitter.polygon.span()) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
      }
    }
    node.centre = 0.5 * (low + high);
    const double length = glm::length(normals);
    node.cos_spread = length > 0.0 ? 1.0 : -1.0;
    if (length > 0.0)
      node.axis = normals / length;
    for (const auto e : range(first, count)) {
      node.cos_spread = std::min(node.cos_spread, glm::dot(node.axis, emitters[e].plane.normal));
      for (const auto& vertex : emitters[e].polygon.span())
        node.radius = std::max(node.radius, glm::distance(vertex, node.centre));
    }
    return node;
  }

  /// Halves the range by its centres, again and again.
  void split(std::uint32_t first, std::uint32_t count) {
    const std::size_t self = tree.nodes.size();
    tree.nodes.push_back(node_over(first, count));
    if (count == 1)
      return;
    const std::uint32_t half = split_at_median(range(first, count), centres, 3);
    split(first, half);
    tree.nodes[self].second_child = static_cast<std::uint32_t>(tree.nodes.size());
    split(first + half, count - half);
  }
};

} // namespace

LightTree make_emitter_tree(std::span<const Emitter> emitters) {
  if (emitters.empty())
    return {};
  Builder builder{emitters, {}, {}};
  for (const auto& emitter : emitters)
    builder.centres.push_back(centre_of(emitter.polygon));
  builder.tree.order.resize(emitters.size());
  std::iota(builder.tree.order.begin(), builder.tree.order.end(), 0U);
  builder.split(0, static_cast<std::uint32_t>(emitters.size()));
  return std::move(builder.tree);
}

} // namespace meninas
