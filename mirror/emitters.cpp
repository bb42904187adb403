#include "mirror/emitters.h"

#include "mirror/median_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meninas {

namespace {

Point3 centre_of(std::span<const Point3> vertices) {
  Point3 sum(0.0);
  for (const auto& vertex : vertices)
    sum += vertex;
  return sum / static_cast<double>(std::max<std::size_t>(vertices.size(), 1));
}

double power_of(const Emitter& emitter) {
  const Rgb& radiosity = emitter.radiosity;
  return emitter.area * std::max({radiosity.r, radiosity.g, radiosity.b});
}

/// The cell of a cube that a direction points to.
std::size_t cube_cell(const Direction& d) {
  constexpr double across = 8.0;
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(d[k]) > std::abs(d[axis]))
      axis = k;
  std::size_t cell = static_cast<std::size_t>(axis) * 2 + (d[axis] < 0.0 ? 1 : 0);
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double place = 0.5 * across * (d[other] / std::abs(d[axis]) + 1.0);
    cell = 8 * cell + static_cast<std::size_t>(std::clamp(place, 0.0, across - 1.0));
  }
  return cell;
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
    const Point3& near = centres[tree.order[first]];
    Vec3 normals(0.0), weighted(0.0);
    for (const auto e : range(first, count)) {
      const Emitter& emitter = emitters[e];
      const double power = power_of(emitter);
      node.power += power;
      weighted += power * (centres[e] - near);
      normals += emitter.plane.normal;
      for (const auto& vertex : emitter.corners) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
      }
    }
    node.centre = 0.5 * (low + high);
    node.middle = node.power > 0.0 ? near + weighted / node.power : node.centre;
    const double length = glm::length(normals);
    node.cos_spread = length > 0.0 ? 1.0 : -1.0;
    if (length > 0.0)
      node.axis = normals / length;
    for (const auto e : range(first, count)) {
      node.cos_spread = std::min(node.cos_spread, glm::dot(node.axis, emitters[e].plane.normal));
      for (const auto& vertex : emitters[e].corners)
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

  /// Adds the flux of each emitter if they are few, else the sums by cells.
  void add_flux() {
    constexpr std::uint32_t few = 32;
    tree.sent.push_back(0.0);
    for (const auto e : tree.order) {
      tree.flux.push_back(power_of(emitters[e]) * emitters[e].plane.normal);
      tree.sent.push_back(tree.sent.back() + power_of(emitters[e]));
    }
    for (EmitterNode& node : tree.nodes) {
      node.first_flux = node.first;
      node.flux_count = node.count;
      if (node.count <= few)
        continue;
      std::array<Vec3, 384> cells{};
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        cells[cube_cell(emitters[tree.order[k]].plane.normal)] += tree.flux[k];
      node.first_flux = static_cast<std::uint32_t>(tree.flux.size());
      std::ranges::copy_if(cells, std::back_inserter(tree.flux),
                           [](const Vec3& flux) { return flux != Vec3(0.0); });
      node.flux_count = static_cast<std::uint32_t>(tree.flux.size()) - node.first_flux;
    }
  }
};

} // namespace

LightTree make_emitter_tree(std::span<const Emitter> emitters) {
  if (emitters.empty())
    return {};
  Builder builder{emitters, {}, {}};
  for (const auto& emitter : emitters)
    builder.centres.push_back(centre_of(emitter.corners));
  builder.tree.order.resize(emitters.size());
  std::iota(builder.tree.order.begin(), builder.tree.order.end(), 0U);
  builder.split(0, static_cast<std::uint32_t>(emitters.size()));
  builder.add_flux();
  return std::move(builder.tree);
}

double intensity_times_pi(const LightTree& tree, const EmitterNode& node, const Direction& omega) {
  double sum = 0.0;
  for (const Vec3& flux : std::span(tree.flux).subspan(node.first_flux, node.flux_count))
    sum += std::max(0.0, glm::dot(flux, omega));
  return sum;
}

} // namespace meninas
