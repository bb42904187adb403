#include "radiosity/hierarchical/node_field.h"

#include "radiosity/field/curved_means.h"
#include "radiosity/field/curves/smooth_vertices.h"
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/light/gather_noise.h"
#include "radiosity/hierarchical/node_gathering.h"
#include "radiosity/field/refine_direct.h"
#include "radiosity/field/vertex_places.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace meninas {

namespace {

constexpr RayShare first_share{ray_reduction, 1};
constexpr double first_spared = 1.0, small_spared = 0.1; // of secondary emitters there

/// The irradiance of elements, from their corners: all of it where they share points for direct light
/// (node_light.h), or else indirect light. Corners do not resolve a spot of a few elements.
std::vector<Rgb> received_at_corners(const ElementLight& elements, const HierarchicalSolution& receivers,
                                     const VertexSamples& found,
                                     const std::vector<glm::vec3>& irradiance,
                                     const std::vector<glm::vec3>& indirect) {
  const VertexEdges edges = edges_of(found.mesh);
  std::vector<Rgb> received = curved_means(found.mesh, edges, irradiance);
  const std::vector<Rgb> rest = curved_means(found.mesh, edges, indirect);
  for (std::size_t e = 0; e < received.size(); ++e)
    if (receivers.share_light[e] == 0)
      received[e] = elements.direct[e] + rest[e];
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

/// The shares of lamps in the light that elements reflect, from their corners.
LightByLamp reflected_by_lamp(const ElementLight& elements, const HierarchicalSolution& receivers,
                              const VertexSamples& found, const std::vector<Rgb>& reflected,
                              std::span<const std::uint8_t> gathered) {
  LightByLamp by_lamp = elements.by_lamp;
  for (std::size_t l = 0; l < found.field.by_lamp.size(); ++l) {
    const auto& [direct, rest] = found.field.by_lamp[l];
    std::vector<glm::vec3> all = direct;
    for (std::size_t v = 0; v < all.size(); ++v)
      all[v] += rest[v];
    const ElementLight of_lamp{.reflected = {},
                               .irradiance = {},
                               .direct = light_of_lamp(elements.direct_by_lamp, l)};
    const std::vector<Rgb> received = received_at_corners(
        of_lamp, receivers, found, filled(found, std::move(all)), filled(found, rest));
    set_light_of_lamp(by_lamp, l,
                      scattered(found.mesh.reflectance, elements.translucent, received));
  }
  // The elements' own light stands in where corners have none.
  const auto is_zero = [](double light) { return light == 0.0; };
  for (std::size_t e = 0; e < by_lamp.rows; ++e)
    if (gathered[e] == 0 || std::ranges::all_of(by_lamp[e], is_zero))
      std::ranges::copy(elements.by_lamp[e], by_lamp[e].begin());
  add_up_to(reflected, by_lamp);
  return by_lamp;
}

/// The outcome of the first gathering.
struct FirstField {
  SentLight sent; ///< B, the radiosity of the elements by the field that they make themselves
  VertexIrradiance field;
  std::vector<VertexState> states;
};

/// By ElementId, 1: the element is below one of these nodes.
std::vector<std::uint8_t> elements_of(const NodeTree& tree, std::span<const TreeNodeId> nodes,
                                      std::size_t count) {
  std::vector<std::uint8_t> below(count, 0);
  for (const TreeNodeId id : nodes)
    for (const ElementId e : elements_below(tree, id))
      below[index(e)] = 1;
  return below;
}

/// Receivers of surfaces on which at least one of 512 rays of a vertex lands in the mean:
/// F = A_surface / A of a closed room.
std::vector<TreeNodeId> met_by_rays(const HierarchicalSolution& receivers,
                                    const LightScene& light) {
  constexpr double rays = 512.0;
  const ElementMesh& mesh = light.mesh;
  const auto surface_of = [&](ElementId e) {
    return index(
        light.surfaces.patches[index(mesh.sides[index(mesh.side_of_element[index(e)])].patch)]
            .surface);
  };
  std::vector<double> area(light.surfaces.surfaces.size(), 0.0);
  for (std::uint32_t e = 0; e < element_count(mesh); ++e)
    area[surface_of(ElementId{e})] += mesh.area[e];
  const double all = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<TreeNodeId> met;
  std::ranges::copy_if(receivers.receivers, std::back_inserter(met), [&](TreeNodeId id) {
    return area[surface_of(elements_below(receivers.tree, id).front())] * rays >= all;
  });
  return met;
}

/// Vertices that are lit and that none of these elements has take the mean of indirect light
/// that the elements around them have been solved to receive.
void take_solved(const ElementLight& elements, std::span<const std::uint8_t> gathered,
                 const VertexIrradiance& lit, std::span<const VertexState> states,
                 VertexSamples& found) {
  VertexIrradiance& field = found.field;
  const VertexElements around = elements_around(found.mesh);
  for (std::uint32_t v = 0; v < states.size(); ++v) {
    const auto here = meninas::around(around, v);
    if (states[v] != VertexState::direct_only ||
        std::ranges::any_of(here, [&](ElementId e) { return gathered[index(e)] != 0; }))
      continue;
    double area = 0.0;
    for (const ElementId e : here)
      area += found.mesh.area[index(e)];
    // The mean of H - D of the elements around, of all light or of one lamp's.
    const auto rest = [&](const auto& arrived, const auto& direct) {
      Rgb sum(0.0);
      for (const ElementId e : here)
        sum += found.mesh.area[index(e)] * glm::max(arrived(index(e)) - direct(index(e)), Rgb(0.0));
      return area > 0.0 ? glm::vec3(sum / area) : glm::vec3(0.0F);
    };
    const auto at = [](const std::vector<Rgb>& values) {
      return [&values](std::uint32_t e) { return values[e]; };
    };
    field.indirect[v] = rest(at(elements.irradiance), at(elements.direct));
    field.irradiance[v] = lit.irradiance[v] + field.indirect[v];
    field.indirect_mirrored[v] = glm::vec3(0.0F);
    field.mirrored[v] = lit.mirrored[v];
    for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
      const auto of_lamp = [l](const LightByLamp& light) {
        return [&light, l](std::uint32_t e) {
          return Rgb(light[e][3 * l], light[e][3 * l + 1], light[e][3 * l + 2]);
        };
      };
      field.by_lamp[l].direct[v] = lit.by_lamp[l].direct[v];
      field.by_lamp[l].indirect[v] =
          rest(of_lamp(elements.irradiance_by_lamp), of_lamp(elements.direct_by_lamp));
    }
    found.states[v] = VertexState::gathered;
  }
}

/// `found` has it in between. Surfaces that are smaller than rays tell apart send what they were solved to.
FirstField first_field(const VertexSource& few, const HierarchicalSolution& receivers,
                       const ElementLight& elements, VertexSamples& found) {
  VertexIrradiance lit = found.field;
  std::vector<VertexState> states = found.states;
  const std::vector<TreeNodeId> nodes = met_by_rays(receivers, few.gathering.light);
  const auto gathered = elements_of(receivers.tree, nodes, element_count(found.mesh));
  share_out(gather_at_nodes({few, few}, receivers, nodes, {}, ray_reduction * receivers.bend, found),
            found);
  take_solved(elements, gathered, lit, states, found);
  std::vector<Rgb> received =
      received_at_corners(elements, receivers, found, filled(found, found.field.irradiance),
                          filled(found, found.field.indirect));
  std::vector<Rgb> reflected = elements.reflected;
  for (std::size_t e = 0; e < received.size(); ++e) {
    if (gathered[e] == 0)
      received[e] = elements.irradiance[e];
    if (elements.irradiance[e] != Rgb(0.0))
      reflected[e] = found.mesh.reflectance[e] * received[e];
  }
  add_from_behind(elements, received, reflected);
  LightByLamp by_lamp = reflected_by_lamp(elements, receivers, found, reflected, gathered);
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
                       seen_by_small = gathering_from(light, reflected, how, {ray_reduction, times},
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
  refine_direct(light, source, {scale, how.interpolation.shadow_bend, how.seen_direct}, std::move(found),
                result);
  return result;
}

} // namespace

InterpolatedField field_by_nodes(const LightScene& light, const ElementLight& elements,
                                 HierarchicalSolution& receivers, const VertexGathering& how) {
  PointWorkspaces workspaces;
  const VertexElements facets =
      elements.direct.empty() ? VertexElements{} : facets_around(light);
  VertexSamples found = std::move(receivers.vertices);
  if (!facets.elements.empty())
    average_facets(light, elements, facets,
                   {how.form_factors, receivers.clustered, how.interpolation.mirrored}, workspaces, found.field);
  InterpolatedField result =
      gathered_at_corners(light, elements, receivers, how, std::move(found), workspaces);
  count_rays(workspaces, result);
  return result;
}

} // namespace meninas
