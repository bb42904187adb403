#include "radiosity/field/refine_direct.h"

#include "radiosity/field/refine_indirect.h"
#include "radiosity/field/curves/facet_edges.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/vertex_light.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace meninas {

namespace {

std::vector<glm::vec3> direct(const VertexIrradiance& field) {
  std::vector<glm::vec3> light = field.irradiance;
  for (std::size_t v = 0; v < light.size(); ++v)
    light[v] -= field.indirect[v];
  return light;
}

bool has_means(const VertexSamples& found, std::size_t element) {
  return std::ranges::any_of(found.mesh.corners[element], [&](ElementVertexId v) {
    return found.states[index(v)] == VertexState::smoothed;
  });
}

/// By direct light. Before the first division there are surfaces of one element:
/// the difference between corners tells that there may be an edge on them.
/// Where these have the mean of many facets it tells how the curve turns, and is left out.
std::vector<double> bends_of(const VertexSamples& found, const BendScale& scale, bool first) {
  const std::vector<glm::vec3> light = direct(found.field);
  std::vector<std::uint8_t> on_lamps;
  for (std::size_t v = 0; v < found.states.size(); ++v) {
    const Rgb& emission = found.mesh.emission[index(found.mesh.element_of_vertex[v])];
    on_lamps.push_back(found.states[v] == VertexState::smoothed && emission != Rgb(0.0) ? 1 : 0);
  }
  std::vector<double> bends =
      interpolation_error(found.mesh, light, scale, of_source, on_lamps);
  if (!first)
    return bends;
  const std::vector<double> at_lone_edges = edge_difference_error(found.mesh, light, scale);
  for (std::size_t e = 0; e < bends.size(); ++e)
    if (!has_means(found, e))
      bends[e] = std::max(bends[e], at_lone_edges[e]);
  return bends;
}

/// The elements that are bent by more than x; if they are more than `most`, the most bent.
std::vector<std::uint8_t> max_bent(const std::vector<double>& bends, double x, std::size_t most) {
  std::vector<double> bent;
  std::ranges::copy_if(bends, std::back_inserter(bent), [x](double bend) { return bend > x; });
  if (bent.size() > most) {
    const auto first_left_out = bent.begin() + static_cast<std::ptrdiff_t>(most);
    std::ranges::nth_element(bent, first_left_out, std::greater<>());
    x = *first_left_out;
  }
  return bent_by_more(bends, x);
}

/// The light of the coarser mesh at a vertex.
struct CoarseLight {
  glm::vec3 irradiance, mirrored, indirect, indirect_mirrored;
  bool beside_covered; ///< in an element with a covered corner
  double solved_size;  ///< of the element that was solved there, m
  ElementPoint place;
};
CoarseLight light_in(const VertexSamples& coarse, const SurfaceModel& surfaces,
                     const ElementMesh& mesh, std::size_t v) {
  const ElementPoint at =
      place_in(coarse.mesh, surfaces, mesh, static_cast<ElementVertexId>(v));
  const auto value = [&](const std::vector<glm::vec3>& values) {
    return value_in(coarse.mesh, values, at);
  };
  const bool beside_covered =
      std::ranges::any_of(coarse.mesh.corners[index(at.element)], [&](ElementVertexId corner) {
        return coarse.states[index(corner)] == VertexState::covered;
      });
  const double times = double(1U << cell_of(coarse.mesh, at.element).level);
  return {value(coarse.field.irradiance),
          value(coarse.field.mirrored),
          value(coarse.field.indirect),
          value(coarse.field.indirect_mirrored),
          beside_covered,
          times * size_of(coarse.mesh, at.element),
          at};
}

/// The same by lamp: indirect light as there, and direct light where the vertex has none of its own.
void take_lamps(const VertexSamples& coarse, const ElementPoint& at, bool covered, std::size_t v,
                VertexIrradiance& field) {
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    const auto& [direct, indirect] = coarse.field.by_lamp[l];
    if (covered)
      field.by_lamp[l].direct[v] = value_in(coarse.mesh, direct, at);
    field.by_lamp[l].indirect[v] = value_in(coarse.mesh, indirect, at);
  }
}

/// Direct light at fresh vertices, and what else is there as the coarser mesh has it.
/// Under things all is as that has it: what is gathered beside them. A cover that is low for the
/// elements that were solved, some of whose corners it covers, is as low for smaller ones.
void compute_direct_at_new(const VertexSource& source, const SurfaceModel& surfaces, std::uint32_t level,
                 const VertexSamples& coarse, VertexSamples& found) {
  VertexIrradiance& field = found.field;
  std::vector<std::uint32_t> fresh; // new, or has hung so far
  for (std::uint32_t v = 0; v < found.states.size(); ++v)
    if (found.states[v] == VertexState::unknown) {
      fresh.push_back(v);
      found.seen[v] = Visibility::uniform;
      field.irradiance[v] = field.mirrored[v] = field.indirect[v] = field.indirect_mirrored[v] =
          glm::vec3(0.0F);
      for (auto& [direct, indirect] : field.by_lamp)
        direct[v] = indirect[v] = glm::vec3(0.0F);
    }
  light_vertices(source, level, found);
  for (const std::uint32_t v : fresh) {
    if (found.states[v] == VertexState::unknown)
      continue;
    const CoarseLight before = light_in(coarse, surfaces, found.mesh, v);
    const bool is_dark = field.irradiance[v] == glm::vec3(0.0F);
    if (found.states[v] == VertexState::covered ||
        (is_dark && before.beside_covered &&
         is_under_something(source.gathering.light, found.receivers[v], before.solved_size))) {
      found.states[v] = VertexState::covered;
      field.irradiance[v] = before.irradiance;
      field.mirrored[v] = before.mirrored;
    } else {
      found.states[v] = VertexState::gathered;
      field.irradiance[v] += before.indirect;
      field.mirrored[v] += before.indirect_mirrored;
    }
    field.indirect[v] = before.indirect;
    field.indirect_mirrored[v] = before.indirect_mirrored;
    take_lamps(coarse, before.place, found.states[v] == VertexState::covered, v, field);
  }
  for (auto& [direct, indirect] : field.by_lamp) {
    settle_hanging(found.mesh, direct);
    settle_hanging(found.mesh, indirect);
  }
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored})
    settle_hanging(found.mesh, *values);
}

double weight_of(const DirectRefinement& wanted, std::size_t element) {
  return wanted.weights.empty() ? 1.0 : double{wanted.weights[element]};
}

/// Facets with edges have direct light of their own at their corners.
void light_faces_with_shadow_edges(const LightScene& light, const VertexSource& source,
                             const DirectRefinement& wanted, std::uint32_t level,
                             VertexSamples& found) {
  if (std::ranges::find(found.states, VertexState::smoothed) == found.states.end())
    return;
  const std::vector<double> bends =
      edge_difference_error(found.mesh, direct(found.field), wanted.scale);
  std::vector<ElementId> bent;
  for (std::uint32_t e = 0; e < bends.size(); ++e)
    if (weight_of(wanted, e) * bends[e] > wanted.x && has_means(found, e))
      bent.push_back(ElementId{e});
  const std::vector<ElementId> facets = faces_with_shadow_edges(light, source, level, found, bent);
  if (facets.empty())
    return;
  const VertexSamples before = found;
  for (const ElementId facet : facets)
    for (const ElementVertexId corner : found.mesh.corners[index(facet)])
      if (found.states[index(corner)] == VertexState::smoothed)
        found.states[index(corner)] = VertexState::unknown;
  compute_direct_at_new(source, light.surfaces, level, before, found);
}

} // namespace

void refine_direct(const LightScene& light, const VertexSource& source,
                   const DirectRefinement& refinement, VertexSamples found,
                   InterpolatedField& result) {
  constexpr std::uint32_t max_divisions = 3, first_level = 0xed9e;
  constexpr std::size_t parts_more = 3;
  if (!(refinement.x > 0.0))
    return;
  const std::size_t solved = element_count(found.mesh), most = solved + max_at_shadows(solved);
  found.field = std::move(result.field);
  std::ranges::replace(found.states, VertexState::low_clearance, VertexState::gathered);
  std::vector<float> weights = parts_of(light.mesh, refinement.weights, found.mesh);
  light_faces_with_shadow_edges(light, source, {refinement.scale, refinement.x, weights},
                          first_level - 1, found);
  std::uint32_t level = 0;
  for (; level < max_divisions; ++level) {
    const std::size_t now = element_count(found.mesh), more = now < most ? most - now : 0;
    if (more < parts_more)
      break;
    std::vector<double> bends = bends_of(found, refinement.scale, level == 0);
    for (std::size_t e = 0; e < weights.size(); ++e)
      bends[e] *= double{weights[e]};
    const auto marked = max_bent(bends, refinement.x, more / parts_more);
    if (std::ranges::find(marked, 1) == marked.end())
      break;
    // Every vertex that has a value keeps it, and none asks anew how it sees the source.
    std::ranges::replace(found.seen, Visibility::uniform, Visibility::confirmed);
    const VertexSamples coarse = std::move(found);
    found = divided(light, coarse, marked);
    compute_direct_at_new(source, light.surfaces, first_level + level, coarse, found);
    weights = parts_of(coarse.mesh, weights, found.mesh);
  }
  result.field = std::move(found.field);
  if (level > 0)
    result.mesh = std::move(found.mesh);
}

} // namespace meninas
