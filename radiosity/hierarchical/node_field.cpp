#include "radiosity/hierarchical/node_field.h"

#include "radiosity/field/curved_means.h"
#include "radiosity/field/curves/smooth_vertices.h"
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/light/gather_noise.h"
#include "radiosity/hierarchical/node_bends.h"
#include "radiosity/hierarchical/node_edges.h"
#include "radiosity/field/refine_direct.h"
#include "radiosity/field/vertex_places.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace meninas {

namespace {

constexpr int few_rays = 4; // for the first gathering, and for small nodes: so many times fewer
constexpr RayShare first_share{few_rays, 1};
constexpr double first_spared = 1.0, small_spared = 0.1; // of bright clusters there

/// What nodes gather from: the same light, with many and with few rays.
struct NodeSource {
  const VertexSource& many;
  const VertexSource& few;
};

/// The rest at vertices, `wanted` the areas that they stand for.
/// Noise counts with the area: in an eighth of a receiver a quarter of the rays adds
/// no more to the squared error than all do in a receiver (gather_noise.h).
void gather_at_wanted(const NodeSource& source, const std::vector<double>& wanted, double receiver,
                      VertexSamples& found) {
  const double small = std::pow(few_rays, -2.0 * noise_order);
  std::vector<std::uint8_t> large(wanted.size(), 0), rest(wanted.size(), 0);
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    large[v] = wanted[v] > small * receiver ? 1 : 0;
    rest[v] = wanted[v] > 0.0 && large[v] == 0 ? 1 : 0;
  }
  gather_at_lit(source.many, large, found);
  gather_at_lit(source.few, rest, found);
}

/// How vertices take from those that gather.
struct NodeInterpolation {
  InterpolationWeights shares;
  std::vector<MidpointStencil> crosses;
};

/// Whether an element is seen, by ElementId; empty: every one is.
using Seen = std::span<const std::uint8_t>;

bool is_seen(const NodeTree& tree, TreeNodeId node, Seen seen) {
  return seen.empty() || std::ranges::any_of(elements_below(tree, node), [&](ElementId e) {
           return seen[index(e)] != 0;
         });
}

/// Takes the nodes of which nothing is seen from these.
std::vector<TreeNodeId> take_unseen(const NodeTree& tree, Seen seen,
                                    std::vector<TreeNodeId>& nodes) {
  const auto unseen = std::ranges::stable_partition(
      nodes, [&](TreeNodeId id) { return is_seen(tree, id, seen); });
  std::vector<TreeNodeId> taken(unseen.begin(), unseen.end());
  nodes.erase(unseen.begin(), unseen.end());
  return taken;
}

/// The rest at the corners and in the middle of nodes as small as it asks for, with a bound of X.
/// Middles alone do not see light that bends one way along a node and the other way across:
/// what edges between nodes tell of that divides once more.
NodeInterpolation gather_at_nodes(const NodeSource& source, const HierarchicalSolution& receivers,
                                  std::vector<TreeNodeId> nodes, Seen seen,
                                  double x, VertexSamples& found) {
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

/// What a vertex takes from those that its shares name, as far as these have values.
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
      found.states[v] = VertexState::lit;
    }
}

/// Gives vertices that are lit the rest of their light:
/// first those between corners of nodes, which others take from.
void share_out(const NodeInterpolation& by, VertexSamples& found) {
  drop_indicator_samples(by.shares, found);
  const std::vector<std::uint8_t> valid = with_values(found);
  const auto take = [&](bool between) {
    for (std::size_t v = 0; v < found.states.size(); ++v)
      if (found.states[v] == VertexState::lit && (by.shares.between[v] != 0) == between)
        take_shares(by.shares, v, found);
  };
  take(true);
  bend_between(by, valid, found);
  take(false);
}

/// What elements receive, by their corners: all of it where they share points for light from the
/// source (node_light.h), or the rest. Of a spot of a few elements corners do not tell the light.
std::vector<Rgb> received_at_corners(const ElementLight& elements, const HierarchicalSolution& receivers,
                                     const VertexSamples& found,
                                     const std::vector<glm::vec3>& irradiance,
                                     const std::vector<glm::vec3>& indirect) {
  const VertexEdges edges = edges_of(found.mesh);
  std::vector<Rgb> received = curved_means(found.mesh, edges, irradiance);
  const std::vector<Rgb> rest = curved_means(found.mesh, edges, indirect);
  for (std::size_t e = 0; e < received.size(); ++e)
    if (receivers.share_light[e] == 0)
      received[e] = elements.from_source[e] + rest[e];
  return received;
}

/// To those of translucent surfaces, in place of what has come through them as they were solved.
void add_from_behind(const ElementLight& elements, std::vector<Rgb> received,
                     std::vector<Rgb>& reflected) {
  if (elements.translucent.empty())
    return;
  for (std::size_t e = 0; e < received.size(); ++e)
    if (elements.irradiance[e] == Rgb(0.0))
      received[e] = Rgb(0.0);
  for (std::size_t e = 0; e < received.size(); ++e) {
    if (elements.irradiance[e] == Rgb(0.0))
      reflected[e] -= passed_from_behind(elements.translucent, e, elements.irradiance);
    reflected[e] =
        glm::max(reflected[e] + passed_from_behind(elements.translucent, e, received), Rgb(0.0));
  }
}

/// What lamps have in the light that elements send on, as their corners tell.
LightByLamp reflected_by_lamp(const ElementLight& elements, const HierarchicalSolution& receivers,
                              const VertexSamples& found, const std::vector<Rgb>& reflected) {
  LightByLamp by_lamp = elements.by_lamp;
  for (std::size_t l = 0; l < found.field.by_lamp.size(); ++l) {
    const auto& [direct, rest] = found.field.by_lamp[l];
    std::vector<glm::vec3> all = direct;
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v] += rest[v];
    const ElementLight of_lamp{.reflected = {},
                               .irradiance = {},
                               .from_source = light_of_lamp(elements.from_source_by_lamp, l)};
    const std::vector<Rgb> received = received_at_corners(
        of_lamp, receivers, found, filled(found, std::move(all)), filled(found, rest));
    set_light_of_lamp(by_lamp, l,
                      scattered(found.mesh.reflectance, elements.translucent, received));
  }
  // Of what corners know nothing the elements' own light tells.
  for (Eigen::Index e = 0; e < by_lamp.rows(); ++e)
    if (by_lamp.row(e).isZero(0.0))
      by_lamp.row(e) = elements.by_lamp.row(e);
  add_up_to(reflected, by_lamp);
  return by_lamp;
}

/// The outcome of the first gathering.
struct FirstField {
  SentLight sent; ///< B, the radiosity of the elements by the field that they make themselves
  VertexIrradiance field;
  std::vector<VertexState> states;
};

/// `found` has it in between.
FirstField first_field(const VertexSource& few, const HierarchicalSolution& receivers,
                       const ElementLight& elements, VertexSamples& found) {
  VertexIrradiance lit = found.field;
  std::vector<VertexState> states = found.states;
  share_out(
      gather_at_nodes({few, few}, receivers, receivers.receivers, {}, few_rays * receivers.bend,
                      found),
      found);
  const std::vector<Rgb> received =
      received_at_corners(elements, receivers, found, filled(found, found.field.irradiance),
                          filled(found, found.field.indirect));
  std::vector<Rgb> reflected = elements.reflected;
  for (std::size_t e = 0; e < received.size(); ++e)
    if (elements.irradiance[e] != Rgb(0.0))
      reflected[e] = found.mesh.reflectance[e] * received[e];
  add_from_behind(elements, received, reflected);
  LightByLamp by_lamp = reflected_by_lamp(elements, receivers, found, reflected);
  std::swap(found.field, lit);
  std::swap(found.states, states);
  return {{std::move(reflected), std::move(by_lamp)}, std::move(lit), std::move(states)};
}

/// By ElementVertexId, 1: no receiver that shows something seen has it.
std::vector<std::uint8_t> left_out_of(std::span<const TreeNodeId> nodes, const NodeTree& tree,
                                      const ElementMesh& mesh) {
  std::vector<std::uint8_t> left_out(mesh.vertices.size(), 1);
  for (const TreeNodeId id : nodes)
    for (const ElementId e : elements_below(tree, id))
      for (const ElementVertexId v : mesh.corners[index(e)])
        left_out[index(v)] = 0;
  return left_out;
}

/// Vertices that no receiver with something seen has keep what the first gathering found.
void keep_first(const FirstField& first, std::span<const std::uint8_t> left_out,
                VertexSamples& found) {
  const auto keep = [&](std::vector<glm::vec3>& values, const std::vector<glm::vec3>& from) {
    for (std::size_t v = 0; v < left_out.size(); ++v)
      if (left_out[v] != 0)
        values[v] = from[v];
  };
  keep(found.field.irradiance, first.field.irradiance);
  keep(found.field.mirrored, first.field.mirrored);
  keep(found.field.indirect, first.field.indirect);
  keep(found.field.indirect_mirrored, first.field.indirect_mirrored);
  for (std::size_t l = 0; l < found.field.by_lamp.size(); ++l) {
    keep(found.field.by_lamp[l].direct, first.field.by_lamp[l].direct);
    keep(found.field.by_lamp[l].indirect, first.field.by_lamp[l].indirect);
  }
  for (std::size_t v = 0; v < left_out.size(); ++v)
    if (left_out[v] != 0)
      found.states[v] = first.states[v];
}

/// `found` has direct light, and the values of vertices that take means of facets.
InterpolatedField gathered_at_corners(const LightScene& light, const ElementLight& elements,
                                      const HierarchicalSolution& receivers, const VertexGathering& how,
                                      VertexSamples found, PointWorkspaces& workspaces) {
  const PointGathering solved =
      gathering_from(light, {elements.reflected, elements.by_lamp}, how, first_share, first_spared);
  RowCache kept;
  // The first gathering, the second, and what edges of shadows take besides.
  const auto part = [&](double from, double to) {
    return StagePart{how.progress, "refinement", from, to};
  };
  const VertexSource few{elements.irradiance, solved, workspaces, &kept, true, part(0.0, 0.4)};
  const FirstField first = first_field(few, receivers, elements, found);
  const SentLight& reflected = first.sent;
  const int times = ray_multiplier(element_count(light.mesh), receivers.receivers.size());
  const PointGathering by_all = gathering_from(light, reflected, how, {}, 0.0, first_share),
                       seen_by_small = gathering_from(light, reflected, how, {few_rays, times},
                                                      small_spared, first_share);
  const std::unique_ptr<const PointGathering> seen_by_large(
      times > 1
          ? new PointGathering(gathering_from(light, reflected, how, {1, times}, 0.0, first_share))
          : nullptr);
  const VertexSource
      source{elements.irradiance, by_all, workspaces, &kept, false, part(0.8, 0.99)},
      by_small{elements.irradiance, seen_by_small, workspaces, &kept, false, part(0.6, 0.8)},
      by_large{elements.irradiance, seen_by_large ? *seen_by_large : by_all, workspaces,
               &kept,               false, part(0.4, 0.6)};
  std::vector<TreeNodeId> nodes = receivers.receivers;
  take_unseen(receivers.tree, how.seen, nodes);
  const auto left_out = left_out_of(nodes, receivers.tree, found.mesh);
  share_out(gather_at_nodes({by_large, by_small}, receivers, std::move(nodes), how.seen,
                            receivers.bend, found),
            found);
  keep_first(first, left_out, found);
  InterpolatedField result{.field = complete_field(source, found)};
  result.received = received_at_corners(elements, receivers, found, result.field.irradiance,
                                        result.field.indirect);
  const BendScale scale = bend_scale(light.mesh, elements.reflected);
  refine_indirect(light, source, scale, how.interpolation.bend, found, result);
  refine_direct(light, source, scale, how.interpolation.shadow_bend, std::move(found), result);
  return result;
}

} // namespace

InterpolatedField field_by_nodes(const LightScene& light, const ElementLight& elements,
                                 HierarchicalSolution& receivers, const VertexGathering& how) {
  PointWorkspaces workspaces;
  const VertexElements facets =
      elements.from_source.empty() ? VertexElements{} : facets_around(light);
  VertexSamples found = std::move(receivers.vertices);
  if (!facets.elements.empty())
    average_facets(light, elements, facets, how.form_factors, workspaces, found.field);
  InterpolatedField result =
      gathered_at_corners(light, elements, receivers, how, std::move(found), workspaces);
  count_rays(workspaces, result);
  return result;
}

} // namespace meninas
