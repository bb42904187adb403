#include "radiosity/hierarchical/node_gathering.h"

#include "radiosity/light/gather_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meninas {

namespace {

/// Indirect light at vertices, `wanted` the areas that they stand for.
/// Noise counts with the area: in an eighth of a receiver a quarter of the rays adds
/// no more to the squared error than all do in a receiver (gather_noise.h).
void gather_at_wanted(const NodeSource& source, const std::vector<double>& wanted, double receiver,
                      VertexSamples& found) {
  const double small = std::pow(ray_reduction, -2.0 * noise_order);
  std::vector<std::uint8_t> large(wanted.size(), 0), rest(wanted.size(), 0);
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    large[v] = wanted[v] > small * receiver ? 1 : 0;
    rest[v] = wanted[v] > 0.0 && large[v] == 0 ? 1 : 0;
  }
  gather_at_lit(source.many, large, found);
  gather_at_lit(source.few, rest, found);
}

bool is_seen(const NodeTree& tree, TreeNodeId node, std::span<const std::uint8_t> seen) {
  return seen.empty() || std::ranges::any_of(elements_below(tree, node), [&](ElementId e) {
           return seen[index(e)] != 0;
         });
}

} // namespace

std::vector<TreeNodeId> take_unseen(const NodeTree& tree, std::span<const std::uint8_t> seen,
                                    std::vector<TreeNodeId>& nodes) {
  const auto unseen = std::ranges::stable_partition(
      nodes, [&](TreeNodeId id) { return is_seen(tree, id, seen); });
  std::vector<TreeNodeId> taken(unseen.begin(), unseen.end());
  nodes.erase(unseen.begin(), unseen.end());
  return taken;
}

NodeInterpolation gather_at_nodes(const NodeSource& source, const HierarchicalSolution& receivers,
                                  std::vector<TreeNodeId> nodes,
                                  std::span<const std::uint8_t> seen, double x,
                                  VertexSamples& found) {
  const ElementMesh& mesh = found.mesh;
  const NodeTree& tree = receivers.tree;
  BendBound bound{bend_scale(mesh, source.many.gathering.reflected), x};
  bound.scale.area *= double(element_count(mesh)) / double(receivers.receivers.size());
  std::vector<TreeNodeId> straight;
  std::vector<std::uint8_t> valid;
  const auto gathered = [&]() -> GatheredVertices {
    valid = with_values(found);
    return {valid, found.field.irradiance, found.field.indirect};
  };
  const auto gather_below = [&](std::vector<TreeNodeId> below) {
    while (!below.empty()) {
      gather_at_wanted(source, wanted_vertices(mesh, tree, below), bound.scale.area, found);
      below = parts_of_bent(mesh, tree, below, gathered(), bound, straight);
      // Parts that are not seen have their corners, and are not asked how light bends in them.
      const std::vector<TreeNodeId> unseen = take_unseen(tree, seen, below);
      gather_at_wanted(source, wanted_vertices(mesh, tree, unseen), bound.scale.area, found);
      std::ranges::copy(unseen, std::back_inserter(straight));
    }
  };
  gather_below(std::move(nodes));
  gather_below(parts_at_bent_edges(mesh, tree, gathered(), bound, straight));
  return {vertex_shares(mesh, tree, straight), crosses_of(mesh, tree, straight)};
}

namespace {

/// A vertex takes the weighted mean of the vertices that its shares name, as far as these have values.
void take_shares(const InterpolationWeights& shares, std::size_t v, VertexSamples& found) {
  VertexIrradiance& field = found.field;
  glm::vec3 total(0.0F), mirrored(0.0F);
  float weights = 0.0F;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::uint32_t from = index(shares.from[v][c]);
    if (!has_value(found.states[from]))
      continue;
    total += shares.weight[v][c] * field.indirect[from];
    mirrored += shares.weight[v][c] * field.indirect_mirrored[from];
    weights += shares.weight[v][c];
  }
  if (!(weights > 0.0F)) {
    found.states[v] = VertexState::covered;
    return;
  }
  for (auto& [direct, rest] : field.by_lamp) {
    glm::vec3 of_lamp(0.0F);
    for (std::size_t c = 0; c < 4; ++c)
      if (const std::uint32_t from = index(shares.from[v][c]); has_value(found.states[from]))
        of_lamp += shares.weight[v][c] * rest[from];
    rest[v] = of_lamp / weights;
  }
  field.indirect[v] = total / weights;
  field.indirect_mirrored[v] = mirrored / weights;
  field.irradiance[v] += field.indirect[v];
  field.mirrored[v] += field.indirect_mirrored[v];
  found.states[v] = VertexState::gathered;
}

/// Adds what is curved to vertices between corners, of those that have a value;
/// light is not negative, and the mirrors' part no more than all.
void bend_between(const NodeInterpolation& by, std::span<const std::uint8_t> valid,
                  VertexSamples& found) {
  VertexIrradiance& field = found.field;
  const std::vector<glm::vec3> bends = edge_bends(by.crosses, valid, field.indirect),
                               of_mirrored = edge_bends(by.crosses, valid, field.indirect_mirrored);
  const auto add = [](const glm::vec3& more, glm::vec3& indirect, glm::vec3& all) {
    const glm::vec3 bent = glm::max(indirect + more, glm::vec3(0.0F));
    all = glm::max(all + (bent - indirect), glm::vec3(0.0F));
    indirect = bent;
  };
  for (std::size_t v = 0; v < bends.size(); ++v)
    if (by.shares.between[v] != 0 && found.states[v] == VertexState::gathered) {
      add(bends[v], field.indirect[v], field.irradiance[v]);
      add(glm::min(of_mirrored[v], field.indirect[v] - field.indirect_mirrored[v]),
          field.indirect_mirrored[v], field.mirrored[v]);
    }
}

/// Vertices that were only asked how light bends, or whose nodes have given way,
/// take from others as those around them do, or they would stand out by what nodes are off.
void drop_indicator_samples(const InterpolationWeights& shares, VertexSamples& found) {
  VertexIrradiance& field = found.field;
  for (std::size_t v = 0; v < found.states.size(); ++v)
    if (found.states[v] == VertexState::gathered && !gathers(shares, v)) {
      // Sums of floats less one of their terms may be a rounding below the others.
      field.irradiance[v] = glm::max(field.irradiance[v] - field.indirect[v], glm::vec3(0.0F));
      field.mirrored[v] = glm::max(field.mirrored[v] - field.indirect_mirrored[v], glm::vec3(0.0F));
      found.states[v] = VertexState::direct_only;
    }
}

} // namespace

void share_out(const NodeInterpolation& by, VertexSamples& found) {
  drop_indicator_samples(by.shares, found);
  const std::vector<std::uint8_t> valid = with_values(found);
  const auto take = [&](bool between) {
    for (std::size_t v = 0; v < found.states.size(); ++v)
      if (found.states[v] == VertexState::direct_only && (by.shares.between[v] != 0) == between)
        take_shares(by.shares, v, found);
  };
  take(true);
  bend_between(by, valid, found);
  take(false);
}

} // namespace meninas
